#include <cstdio>
#include <filesystem>

#include "framework/app/verbs.h"
#include "framework/config/resolve.h"
#include "framework/image/image_io.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/metric.h"
#include "framework/metric/difference_image.h"
#include "framework/metric/measure.h"
#include "framework/report/text_table.h"

namespace dvrlab {
namespace {

FrameImage image_of(const std::string& name) {
  std::error_code ec;
  return read_exr(std::filesystem::is_directory(name, ec) ? name + "/image.exr" : name);
}

/// Every metric that is there, with its default parameters; one that has a required parameter cannot take part.
std::vector<Measure> all_metrics(const Registry& registry, const FrameImage& a, const FrameImage& b) {
  std::vector<Measure> measures;
  for (const PluginEntryInfo& entry : registry.entries()) {
    if (entry.kind != "metric" || entry.descriptor == nullptr) continue;
    const PluginDescriptor& d = *entry.descriptor;
    Problems problems;
    nlohmann::json defaults;
    const ParameterSet p =
        resolve_keys({}, entry.name, {{d.parameters, d.parameters + d.parameter_count}, {}, {}}, problems, defaults);
    if (problems.empty())
      measures.push_back({"b", entry.name, registry.get<MetricPlugin>("metric", entry.name).compare(p, a, b)});
  }
  return measures;
}

}  // namespace

int compare_verb(const Options& o) {
  const Registry registry(o.plugin_path);
  const FrameImage a = image_of(o.a), b = image_of(o.b);
  if (a.width != b.width || a.height != b.height) {
    throw InputError("the images differ in size: " + o.a + " has " + std::to_string(a.width) + "x" +
                     std::to_string(a.height) + " pixels, " + o.b + " has " + std::to_string(b.width) + "x" +
                     std::to_string(b.height));
  }
  if (!o.difference.empty()) write_png(o.difference, difference_image(a, b, false), false);
  const VariantCheck bits = compare_bits(a, b);
  const bool equal = o.tolerance > 0 ? bits.max_abs <= o.tolerance : bits.different == 0;
  std::vector<std::vector<std::string>> rows = {{"metric", "value"}};
  nlohmann::json values = nlohmann::json::object();
  for (const Measure& m : all_metrics(registry, a, b)) {
    for (const auto& [name, value] : m.values) {
      values[name] = json_number(value);
      rows.push_back({name, values[name].dump()});
    }
  }
  if (o.json) {
    const nlohmann::json all = {{"equal", equal},
                                {"tolerance", o.tolerance},
                                {"different_floats", bits.different},
                                {"max_abs", json_number(bits.max_abs)},
                                {"metrics", values}};
    std::printf("%s\n", all.dump(1).c_str());
  }
  std::fprintf(stderr, "%s%s: %llu of %zu numbers differ, by at most %s\n", text_table(rows).c_str(),
               equal ? "equal" : "different", static_cast<unsigned long long>(bits.different),
               a.color.size() + a.trans.size(), json_number(bits.max_abs).dump().c_str());
  return equal ? 0 : 1;
}

}  // namespace dvrlab
