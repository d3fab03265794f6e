// Segments of rays through a mesh beside VTK's linear ray integrator (Moreland and Angel 2004), which splits them at
// the nodes of the transfer functions as we do.
#include <vtkColorTransferFunction.h>
#include <vtkDoubleArray.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "framework/scene/probe.h"
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {
using nlohmann::json;

// At common nodes: VTK 9.1 takes those of the colour for both.
const json density = {{0, 0.1}, {0.2, 4}, {0.45, 0}, {0.7, 0.3}, {0.8, 9}, {1, 2}};
const json chromaticity = {{0, 0.1, 0.2, 0.9}, {0.2, 0.3, 0.9, 0.9}, {0.45, 0.4, 0.9, 0.8},
                           {0.7, 1, 0.7, 0.2}, {0.8, 0.6, 0.8, 0.2}, {1, 0.9, 0.2, 0.3}};

json through_mesh() {
  return {
      {"data",
       {{"type", "procedural"},
        {"field", "marschner_lobb"},
        {"evaluate", "mesh"},
        {"cells", "tetrahedra5"},
        {"size", {9, 9, 9}},
        {"jitter", 0.3}}},
      {"optical_model",
       {{"type", "volume_density"},
        {"tf", "nodes"},
        {"tf_range", {0, 1}},
        {"density", density},
        {"chromaticity", chromaticity}}},
      {"estimator", {{"type", "exact"}}},
      {"precision", "fp64"},
      {"camera",
       {{"type", "perspective"}, {"frame", "data"}, {"position", {1.4, -2, 1.5}}, {"up", {0, 0, 1}}, {"fov_deg", 30}}},
      {"sampling", {{"type", "faces"}, {"step", 100}, {"unit", "voxel"}, {"termination", 0}}},
      {"image", {{"size", {24, 24}}}},
      {"backend", {{"type", "cpu"}}}};
}

/// VTK's result for one segment at a time.
class VtkIntegrator {
 public:
  VtkIntegrator() {
    vtkNew<vtkPiecewiseFunction> extinction;
    for (const json& n : density) extinction->AddPoint(n[0], n[1]);
    vtkNew<vtkColorTransferFunction> color;
    for (const json& n : chromaticity) color->AddRGBPoint(n[0], n[1], n[2], n[3]);
    volume_->GetProperty()->SetScalarOpacity(extinction);
    volume_->GetProperty()->SetColor(color);
    vtkNew<vtkDoubleArray> values;  // their range is looked at
    values->InsertNextValue(0);
    values->InsertNextValue(1);
    for (vtkDoubleArray* a : {near_.Get(), far_.Get(), length_.Get()}) a->SetNumberOfValues(1);
    integrator_->Initialize(volume_, values);
  }

  /// Radiance, and opacity as the fourth.
  std::array<float, 4> segment(double length, double v0, double v1) {
    std::array<float, 4> color{};
    length_->SetValue(0, length);
    near_->SetValue(0, v0);
    far_->SetValue(0, v1);
    integrator_->Integrate(length_, near_, far_, color.data());
    return color;
  }

 private:
  vtkNew<vtkVolume> volume_;
  vtkNew<vtkDoubleArray> near_, far_, length_;
  vtkNew<vtkUnstructuredGridLinearRayIntegrator> integrator_;
};

TEST(VtkIntegrator, HasOurSegments) {
  const Scene scene = scene_of(through_mesh());
  const Field& field = *scene.field;
  VtkIntegrator vtk;
  double worst = 0, brightest = 0;
  int compared = 0;
  for (int y = 0; y < 24; ++y) {
    for (int x = 0; x < 24; ++x) {
      const std::vector<ProbeSegment> ray = probe_ray(scene, registry(), x, y);
      // The front value of a segment is the back value of the one before; the first has none.
      for (std::size_t k = 1; k < ray.size(); ++k) {
        if (std::abs(ray[k].s - ray[k].length - ray[k - 1].s) > 1e-9) continue;
        const auto physical = [&](double stored) { return field.slope * stored + field.intercept; };
        const auto theirs = vtk.segment(ray[k].length, physical(ray[k - 1].value), physical(ray[k].value));
        for (std::size_t c = 0; c < 3; ++c) {
          worst = std::max(worst, std::abs(ray[k].color[c] - double(theirs[c])));
          brightest = std::max(brightest, ray[k].color[c]);
        }
        worst = std::max(worst, std::abs(1 - ray[k].trans[0] - double(theirs[3])));
        ++compared;
      }
    }
  }
  std::printf("%d segments, brightest %.3g, worst difference %.3g\n", compared, brightest, worst);
  EXPECT_GT(compared, 5000);
  EXPECT_GT(brightest, 0.3);
  EXPECT_LE(worst, 5e-6) << "VTK's colours are float";
}

}  // namespace
}  // namespace dvrlab::test
