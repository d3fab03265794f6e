// The `my_illumination` pass: Lambert's diffuse reflection without highlights.
#include "framework/interfaces/illumination.h"

namespace dvrlab::my_illumination {
namespace {

const Parameter parameters[] = {
    {"ambient", ParameterType::number, "", "0.2", "[0,1]", "Part of the colour that needs no light.", Affects::pixels,
     "", "0.6"},
};

class MyIllumination : public IlluminationPlugin {
 public:
  // `shading` holds the config's lights already; the framework's shading kernel evaluates it.
  void shade(const ParameterSet& p, LocalShading& shading) const override {
    shading.mode = LocalShading::Mode::blinn_phong;
    shading.ambient = p.number("ambient");
    shading.diffuse = 1 - shading.ambient;
    shading.specular = 0;
  }
};

}  // namespace

DVRLAB_PLUGIN("illumination", "my_illumination", "0.1", MyIllumination, parameters,
              "diffuse reflection without highlights, ambient and diffuse parts sum up to 1", "")

}  // namespace dvrlab::my_illumination
