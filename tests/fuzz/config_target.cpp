// The input is a config: parsed, resolved against all plugins, and planned. Nothing is rendered.
#include <string>

#include "framework/config/experiment.h"
#include "framework/plugin/registry.h"
#include "tests/fuzz/fuzz_target.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace dvrlab;
  static const Registry registry;
  const std::string text(reinterpret_cast<const char*>(data), size);
  fuzz::expect_result_or_error([&] { plan_experiment(parse_document(text, "input.json", "/nonexistent"), registry); });
  return 0;
}
