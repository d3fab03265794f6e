#include "framework/scene/image_setting.h"

#include "framework/interfaces/transfer_function.h"
#include "framework/scene/camera.h"

namespace dvrlab {

std::array<int, 2> rays_of_image(const ResolvedCase& c) {
  const nlohmann::json& size = c.image.json("size");
  const auto per_side = static_cast<int>(c.image.integer("supersampling"));
  return {size[0].get<int>() * per_side, size[1].get<int>() * per_side};
}

ImageSetting image_setting(const ResolvedCase& c, const Field& field, const Medium& medium,
                           const MediumTableOptions& options) {
  ImageSetting s;
  const auto [width, height] = rays_of_image(c);
  add_camera(c.camera, field, width, height, s.rays);
  add_clipping(c.clip, field, s.rays);
  const bool linear = c.image.text("space") == "linear";
  s.background = c.image.vector3("background");
  for (double& x : s.background) x = linear ? display_to_linear(x) : x;
  s.glows_without_extinction = medium.glows_without_extinction();
  for (int e = 0; e < options.entries; ++e) {
    const auto x = medium.at(options.lo + (options.hi - options.lo) * e / (options.entries - 1));
    const auto of = [&](Term t, int channel) { return x[std::size_t(column(t, channel))]; };
    for (int ch = 0; ch < 3; ++ch) {
      s.lit.push_back(of(Term::P, ch) + of(Term::S_l, ch));
      s.emitted.push_back(of(Term::E, ch));
    }
    s.lit.push_back(of(Term::tau_l, 0));
    s.emitted.push_back(0);
  }
  return s;
}

}  // namespace dvrlab
