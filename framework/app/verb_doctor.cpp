#include <cstdio>

#include "framework/app/doctor_text.h"
#include "framework/app/verbs.h"
#include "framework/report/pretty_json.h"

namespace dvrlab {

int doctor_verb(const Options& o) {
  const Registry registry(o.plugin_path, MissingRoots::found);
  const Doctor doctor = examine(registry);
  std::fputs(o.json ? (pretty_json(doctor_json(doctor)) + "\n").c_str() : doctor_text(doctor).c_str(), stdout);
  return doctor.can_render() ? 0 : 3;
}

}  // namespace dvrlab
