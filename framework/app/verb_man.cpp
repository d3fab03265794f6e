#include <cstdio>

#include "framework/app/man_page.h"
#include "framework/app/verbs.h"
#include "framework/interfaces/error.h"

namespace dvrlab {

int man_verb(const Options& o) {
  if (o.json) throw InputError("man: has no --json; `dvrlab help --json` prints the command line as data");
  std::fputs(man_page(program_model()).c_str(), stdout);
  return 0;
}

}  // namespace dvrlab
