#include <cstdio>

#include "framework/app/single_case.h"
#include "framework/app/verbs.h"
#include "framework/interfaces/error.h"
#include "framework/render_case.h"
#include "framework/report/log.h"
#include "framework/report/number_text.h"
#include "framework/report/pretty_json.h"
#include "framework/report/text_table.h"
#include "framework/scene/probe.h"

namespace dvrlab {
namespace {

std::string table_of(const std::vector<ProbeSegment>& segments, const Field& field, Precision precision) {
  const int digits = precision == Precision::fp64 ? 17 : 9;  // what it takes to tell two of them apart
  const auto number = [&](double x) { return number_text(x, digits); };
  const auto triple = [&](const std::array<double, 3>& v) {
    return number(v[0]) + " " + number(v[1]) + " " + number(v[2]);
  };
  std::vector<std::vector<std::string>> rows = {{"segment", "arc length", "length", "value", "radiance r g b",
                                                 "transmittance r g b", "ray: radiance so far",
                                                 "ray: transmittance so far"}};
  for (const ProbeSegment& q : segments) {
    rows.push_back({std::to_string(q.index), number(q.s), number(q.length),
                    number(field.slope * q.value + field.intercept), triple(q.color), triple(q.trans),
                    triple(q.color_behind), triple(q.trans_behind)});
  }
  return text_table(rows);
}

nlohmann::ordered_json json_of(const std::vector<ProbeSegment>& segments, const Field& field) {
  nlohmann::ordered_json list = nlohmann::ordered_json::array();
  for (const ProbeSegment& q : segments) {
    list.push_back({{"segment", q.index},
                    {"arc_length", q.s},
                    {"length", q.length},
                    {"value", field.slope * q.value + field.intercept},
                    {"radiance", q.color},
                    {"transmittance", q.trans},
                    {"ray_radiance", q.color_behind},
                    {"ray_transmittance", q.trans_behind}});
  }
  return list;
}

void require_pixel(int x, int y, const nlohmann::json& size) {
  if (x >= 0 && y >= 0 && x < size[0].get<int>() && y < size[1].get<int>()) return;
  throw InputError("--pixel: " + std::to_string(x) + "," + std::to_string(y) + " is outside the image of " +
                   size[0].dump() + " x " + size[1].dump() + " pixels");
}

}  // namespace

int probe_verb(const Options& o) {
  const Registry registry(o.plugin_path);
  CaseRenderer renderer(registry);  // looks at the memory before data takes some of it
  const auto [planned, field] = single_case(o, registry);
  if (field != nullptr) renderer.keep(planned.resolved, field);
  require_pixel(o.pixel.at(0), o.pixel.at(1), planned.resolved.image.json("size"));
  CaseRecord record;
  record.plan = &planned;
  const Scene& scene = renderer.scene(planned.resolved, record);
  const int n = scene.rays_per_side;
  if (n > 1)
    log_line("scene", "image.supersampling: this is one of the " + std::to_string(n * n) +
                          " rays of the pixel, nearest to its centre");
  const std::vector<ProbeSegment> segments =
      probe_ray(scene, registry, o.pixel.at(0) * n + n / 2, o.pixel.at(1) * n + n / 2);
  std::fputs((o.json ? pretty_json(json_of(segments, *scene.field)) + "\n"
                     : table_of(segments, *scene.field, scene.job.precision))
                 .c_str(),
             stdout);
  if (segments.empty())
    std::fprintf(stderr, "backend: the ray of pixel %d,%d has no segment: it misses the data, or all of it is empty\n",
                 o.pixel[0], o.pixel[1]);
  return 0;
}

}  // namespace dvrlab
