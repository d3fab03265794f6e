#include <cstdio>

#include "framework/app/single_case.h"
#include "framework/app/verbs.h"
#include "framework/image/atomic_file.h"
#include "framework/image/image_io.h"
#include "framework/interfaces/error.h"
#include "framework/render_case.h"
#include "framework/report/log.h"

namespace dvrlab {

int render_verb(const Options& o) {
  const bool exr = o.output.ends_with(".exr");
  if (!exr && !o.output.ends_with(".png"))
    throw InputError("-o " + o.output + ": the image's name must end in .exr or .png");
  require_writable(o.output);
  const Registry registry(o.plugin_path);
  CaseRenderer renderer(registry);  // looks at the memory before data takes some of it
  const auto [planned, field] = single_case(o, registry);
  if (field != nullptr) renderer.keep(planned.resolved, field);
  CaseRecord record;
  record.plan = &planned;
  const Scene& scene = renderer.scene(planned.resolved, record);
  const FrameImage image = renderer.render(planned.resolved, scene, record);
  record.ran = true;
  if (exr) {
    write_exr(o.output, image, {{"dvrlab:case", planned.id}, {"dvrlab:device", record.device.device}});
  } else {
    write_png(o.output, image, planned.resolved.image.text("space") == "linear");
  }
  for (const PhaseStatistics& t : record.times) {
    char text[64];
    std::snprintf(text, sizeof text, ": %.4g ms", t.median * 1000);
    log_line("backend", t.phase + text);
  }
  log_line("image", o.output);
  if (o.json) std::printf("%s\n", case_json(record).dump(1).c_str());
  return 0;
}

}  // namespace dvrlab
