// Meshes beside VTK's unstructured volume mappers: the same file, view, transfer functions and size of image, in one
// process, one frame of each per round. Built when VTK is there; needs a display (./dev bench vtk brings its own).
// Prints a Markdown table and, with --images, writes what each drew.
#include <vtkCamera.h>
#include <vtkColorTransferFunction.h>
#include <vtkNew.h>
#include <vtkPiecewiseFunction.h>
#include <vtkPointData.h>
#include <vtkProjectedTetrahedraMapper.h>
#include <vtkRenderWindow.h>
#include <vtkRenderer.h>
#include <vtkUnsignedCharArray.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridLinearRayIntegrator.h>
#include <vtkUnstructuredGridPartialPreIntegration.h>
#include <vtkUnstructuredGridVolumeRayCastMapper.h>
#include <vtkVersion.h>
#include <vtkVolume.h>
#include <vtkVolumeProperty.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <filesystem>
#include <functional>

#include "bench/support/config_scene.h"
#include "bench/support/march_scene.h"
#include "framework/image/image_io.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh.h"

namespace {
using namespace dvrlab;
using namespace dvrlab::bench;

const char* const config = "bench/configs/meshes.json";

struct Cost {
  std::vector<double> wall, cpu;
  FrameImage image;  // black background, clamped to [0, 1]
};

/// One mapper of VTK with a window of its own.
class Peer {
 public:
  Peer(vtkUnstructuredGridVolumeMapper* mapper, const Scene& scene, const nlohmann::json& sections) : scene_(scene) {
    const MeshField& mesh = dynamic_cast<const MeshField&>(*scene.field);
    const std::filesystem::path folder =
        std::filesystem::path(DVRLAB_SOURCE "/") / std::filesystem::path(config).parent_path();
    reader_->SetFileName((folder / sections["data"]["file"].get<std::string>()).c_str());
    reader_->Update();
    reader_->GetOutput()->GetPointData()->SetActiveScalars(sections["data"]["array"].get<std::string>().c_str());
    mapper->SetInputConnection(reader_->GetOutputPort());
    volume_->SetMapper(mapper);
    transfer_functions(mesh, sections["optical_model"]);
    camera(mesh, sections["camera"]);
    renderer_->AddVolume(volume_);
    renderer_->SetBackground(0, 0, 0);
    window_->SetMultiSamples(0);
    window_->SetOffScreenRendering(1);
    window_->SetSize(scene.job.width, scene.job.height);
    window_->AddRenderer(renderer_);
    renderer_->ResetCameraClippingRange();
  }

  void frame(Cost& cost) {
    const double cpu = process_seconds(), wall = wall_seconds();
    window_->Render();
    vtkNew<vtkUnsignedCharArray> pixels;  // read back: the frame is finished
    window_->GetPixelData(0, 0, scene_.job.width - 1, scene_.job.height - 1, 1, pixels);
    cost.wall.push_back(1e3 * (wall_seconds() - wall));
    cost.cpu.push_back(1e3 * (process_seconds() - cpu));
    const int w = scene_.job.width, h = scene_.job.height;
    cost.image = {w, h, std::vector<float>(3 * std::size_t(w) * h), std::vector<float>(3 * std::size_t(w) * h)};
    for (int y = 0; y < h; ++y)  // VTK's first row is the bottom one
      for (int k = 0; k < 3 * w; ++k)
        cost.image.color[std::size_t(y) * 3 * w + k] =
            float(pixels->GetValue(vtkIdType(h - 1 - y) * 3 * w + k)) / 255.0F;
  }

 private:
  // The curve of opacity is an extinction per unit distance here; it is kept at 1 or below, since some mappers clamp
  // it.
  void transfer_functions(const MeshField& mesh, const nlohmann::json& model) {
    const double lo = mesh.slope * mesh.stored_min + mesh.intercept,
                 range = mesh.slope * (mesh.stored_max - mesh.stored_min);
    double most = 0;
    for (const auto& n : model["density"]) most = std::max(most, n[1].get<double>());
    vtkNew<vtkPiecewiseFunction> extinction;
    for (const auto& n : model["density"])
      extinction->AddPoint(lo + range * n[0].get<double>(), n[1].get<double>() / most);
    vtkNew<vtkColorTransferFunction> color;
    for (const auto& n : model["chromaticity"]) color->AddRGBPoint(lo + range * n[0].get<double>(), n[1], n[2], n[3]);
    vtkVolumeProperty* p = volume_->GetProperty();
    p->SetScalarOpacity(extinction);
    p->SetColor(color);
    p->SetScalarOpacityUnitDistance(1 / most);
    p->SetInterpolationTypeToLinear();
    p->ShadeOff();
  }

  // Frame "data": centre of the box, in units of half its diagonal, which are the mesh's sampler coordinates.
  void camera(const MeshField& mesh, const nlohmann::json& section) {
    const Vector3 from = mesh.to_world.point(section["position"]), to = mesh.to_world.point(section["target"]);
    vtkCamera* c = renderer_->GetActiveCamera();
    c->SetPosition(from.data());
    c->SetFocalPoint(to.data());
    c->SetViewUp(section["up"].get<Vector3>().data());
    c->SetViewAngle(section["fov_deg"]);
  }

  const Scene& scene_;
  vtkNew<vtkXMLUnstructuredGridReader> reader_;
  vtkNew<vtkVolume> volume_;
  vtkNew<vtkRenderer> renderer_;
  vtkNew<vtkRenderWindow> window_;
};

vtkNew<vtkUnstructuredGridVolumeRayCastMapper> ray_caster(vtkUnstructuredGridVolumeRayIntegrator* integrator,
                                                          int threads) {
  vtkNew<vtkUnstructuredGridVolumeRayCastMapper> mapper;
  mapper->SetRayIntegrator(integrator);
  mapper->SetNumberOfThreads(threads);
  mapper->AutoAdjustSampleDistancesOff();
  mapper->SetImageSampleDistance(1);
  return mapper;
}

/// In 8 bits, as a screen shows them.
double psnr(const FrameImage& a, const FrameImage& b) {
  double sum = 0;
  const auto byte = [](float v) { return std::round(255 * std::clamp(v, 0.0F, 1.0F)); };
  for (std::size_t i = 0; i < a.color.size(); ++i) sum += std::pow(byte(a.color[i]) - byte(b.color[i]), 2);
  return 10 * std::log10(255 * 255 * double(a.color.size()) / sum);
}

struct Row {
  std::string name, file;
  std::function<void(Cost&)> frame;
  Cost cost;
};

void print(const std::vector<Row>& rows) {
  std::printf(
      "| renderer | first frame, wall ms | wall ms, least | CPU ms, least | wall ratio of the least | wall ratio, "
      "median | "
      "CPU ratio of the least | PSNR against exact, 8 bits, dB |\n|---|---|---|---|---|---|---|---|\n");
  const Cost& ours = rows.front().cost;
  const auto later = [](const std::vector<double>& v) { return std::vector<double>(v.begin() + 1, v.end()); };
  for (const Row& r : rows) {
    const std::vector<double> wall = later(r.cost.wall), cpu = later(r.cost.cpu);
    std::vector<double> ratio;
    for (std::size_t k = 0; k < wall.size(); ++k) ratio.push_back(wall[k] / ours.wall[k + 1]);
    std::printf("| %s | %.0f | %.0f | %.0f | %.1f | %.1f | %.1f | %.1f |\n", r.name.c_str(), r.cost.wall[0],
                least(wall), least(cpu), least(wall) / least(later(ours.wall)), median(ratio),
                least(cpu) / least(later(ours.cpu)), psnr(r.cost.image, ours.image));
  }
}

void compare(int rounds, int threads, const std::vector<std::string>& set, const std::string& folder) {
  const Scene scene = config_scene(config, "", set);
  const nlohmann::json sections = config_sections(config, set);
  const auto session = open_backend(R"({"type":"cpu","threads":)" + std::to_string(threads) + "}");
  vtkNew<vtkUnstructuredGridLinearRayIntegrator> linear;
  vtkNew<vtkUnstructuredGridPartialPreIntegration> partial;
  vtkNew<vtkProjectedTetrahedraMapper> projected_mapper;
  Peer bunyk_linear(ray_caster(linear, threads), scene, sections),
      bunyk_partial(ray_caster(partial, threads), scene, sections), projected(projected_mapper, scene, sections);
  const std::string version = std::string("VTK ") + vtkVersion::GetVTKVersion();
  std::vector<Row> rows;
  rows.push_back({"dvrlab cpu, exact",
                  "dvrlab_exact",
                  [&](Cost& c) {
                    FrameResult r;
                    const double cpu = process_seconds(), wall = wall_seconds();
                    session->render(scene.job, r);
                    c.wall.push_back(1e3 * (wall_seconds() - wall));
                    c.cpu.push_back(1e3 * (process_seconds() - cpu));
                    c.image = std::move(r.image);
                  },
                  {}});
  rows.push_back({version + ", Bunyk, linear integrator", "bunyk_linear", [&](Cost& c) { bunyk_linear.frame(c); }, {}});
  rows.push_back(
      {version + ", Bunyk, partial pre-integration", "bunyk_partial", [&](Cost& c) { bunyk_partial.frame(c); }, {}});
  rows.push_back(
      {version + ", projected tetrahedra", "projected_tetrahedra", [&](Cost& c) { projected.frame(c); }, {}});
  for (int k = 0; k <= rounds; ++k)
    for (Row& r : rows) r.frame(r.cost);
  print(rows);
  if (folder.empty()) return;
  std::filesystem::create_directories(folder);
  for (const Row& r : rows) write_png(folder + "/" + r.file + ".png", r.cost.image, false);
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"Meshes beside VTK's unstructured volume mappers"};
  int rounds = 5, threads = 2;
  std::vector<std::string> set;
  std::string folder;
  app.add_option("--rounds", rounds, "timed frames of each")->capture_default_str()->check(CLI::Range(1, 1000));
  app.add_option("--threads", threads, "threads of the ray casters")->capture_default_str()->check(CLI::Range(1, 256));
  app.add_option("--set", set, std::string("key=value of ") + config);
  app.add_option("--images", folder, "folder for what each drew");
  CLI11_PARSE(app, argc, argv);
  try {
    compare(rounds, threads, set, folder);
  } catch (const NotSupported& reason) {
    std::printf("not supported: %s\n", reason.what());
  }
  return 0;
}
