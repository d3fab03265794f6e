#include <cstdio>

#include "framework/app/verbs.h"
#include "framework/config/schema.h"
#include "framework/image/atomic_file.h"
#include "framework/plugin/registry.h"
#include "framework/report/pretty_json.h"

namespace dvrlab {

int schema_verb(const Options& o) {
  if (!o.output.empty()) require_writable(o.output);
  const Registry registry(o.plugin_path);
  const std::string text = pretty_json(config_schema(registry)) + "\n";
  if (o.output.empty()) {
    std::fputs(text.c_str(), stdout);
    return 0;
  }
  write_text_atomically(o.output, text);
  std::fprintf(stderr, "config: the JSON Schema of all configs is in %s\n", o.output.c_str());
  return 0;
}

}  // namespace dvrlab
