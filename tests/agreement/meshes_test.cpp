// Agreement of walks through meshes: the same bits on every backend and instruction set, on real data.
#include <cstdio>

#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

struct MeshCase {
  std::string name;
  json data;
  json estimator = {{"type", "exact"}};
  bool shaded = false;
};
void PrintTo(const MeshCase& c, std::ostream* out) { *out << c.name; }

std::string shipped(const std::string& file) { return std::string(DVRLAB_SOURCE) + "/data/" + file; }

json config_of(const MeshCase& c) {
  json config = {
      {"data", c.data},
      {"optical_model",
       {{"type", "absorption_emission"},
        {"tf", "nodes"},
        {"tf_domain", "normalized"},
        {"length_unit", "voxel"},
        {"shaded", c.shaded},
        {"extinction", {{0, 0.02}, {0.2, 0.1}, {0.3, 1}, {0.4, 0.05}, {1, 0.6}}},
        {"color", {{0, 0.2, 0.4, 1}, {0.3, 1, 0.8, 0.3}, {1, 0.9, 0.3, 0.2}}}}},
      {"estimator", c.estimator},
      {"camera", {{"type", "perspective"}, {"position", {1.3, -2.2, 1.1}}, {"up", {0, 0, 1}}, {"fov_deg", 34}}},
      {"image", {{"size", {48, 40}}}}};
  if (c.shaded) config["illumination"] = {{{"type", "blinn_phong"}, {"specular", 0.3}}};
  return config;
}

class AgreementOfMeshes : public testing::TestWithParam<MeshCase> {};

TEST_P(AgreementOfMeshes, SameBitsOnEveryTarget) {
  const json config = config_of(GetParam());
  const FrameResult first = render(config, targets().front());
  EXPECT_GT(first.counters.samples, 1000u);
  for (const Target& target : targets()) {
    try {
      const FrameResult other = render(config, target);
      const std::size_t values = differing_values(first.image, other.image);
      std::printf("%s: %zu values differ, by at most %g\n", target.name.c_str(), values,
                  largest_difference(first.image, other.image));
      EXPECT_EQ(values, 0u) << target.name;
      EXPECT_EQ(first.counters.samples, other.counters.samples) << target.name;
    } catch (const NotSupported& e) {
      std::printf("%s: not supported: %s\n", target.name.c_str(), e.what());
    }
  }
}

const json bluntfin = {{"type", "vtu"}, {"file", shipped("bluntfin_tets.vtu")}};
const json disk = {{"type", "vtu"}, {"file", shipped("disk_out_ref.vtu")}, {"array", "Temp"}};
const json cylinder = {{"type", "vtk"}, {"file", shipped("CylinderQuadratic.vtk")}, {"array", "velocity_norm"}};
const json notch = {{"type", "vtu"}, {"file", shipped("notch_disp.vtu")}, {"component", "norm"}};

json with(json data, const char* key, const json& value) {
  data[key] = value;
  return data;
}

INSTANTIATE_TEST_SUITE_P(
    Meshes, AgreementOfMeshes,
    testing::Values(MeshCase{"bluntfin", bluntfin}, MeshCase{"bluntfin_shaded", bluntfin, {{"type", "exact"}}, true},
                    MeshCase{
                        "bluntfin_cell_gradients", with(bluntfin, "normals", "cell"), {{"type", "power_series"}}, true},
                    MeshCase{"bluntfin_rk4", bluntfin, {{"type", "rk4"}}},
                    MeshCase{"bluntfin_average", bluntfin, {{"type", "average"}, {"rule", "mean_density"}}},
                    MeshCase{"disk", disk}, MeshCase{"disk_shaded", disk, {{"type", "exact"}}, true},
                    MeshCase{"disk_cell_gradients", with(disk, "normals", "cell"), {{"type", "approximative"}}, true},
                    MeshCase{"cylinder", cylinder}, MeshCase{"cylinder_shaded", cylinder, {{"type", "exact"}}, true},
                    MeshCase{"notch", notch}, MeshCase{"notch_shaded", notch, {{"type", "exact"}}, true}),
    [](const auto& instance) { return instance.param.name; });

}  // namespace
}  // namespace dvrlab::test
