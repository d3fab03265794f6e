// One world frame for every reader (docs/adr/0002), held by pictures: the same scan in another order of its voxels,
// with the affine that belongs to it, gives the same picture from the same place in the world.
#include <cmath>
#include <cstdio>
#include <cstring>
#include <fstream>

#include "tests/agreement/one_scan.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

std::string shipped(const std::string& name) { return std::string(DVRLAB_SOURCE) + "/data/" + name; }

bool have(const std::string& reader) {
  for (const PluginEntryInfo& e : registry().entries())
    if (e.kind == "data" && e.name == reader) return true;
  return false;
}

TEST(Orientation, FiveNiftiFilesOneWorld) {
  const std::string ras = shared_data("nifti_orientation/RAS.nii.gz");
  if (ras.empty()) GTEST_SKIP() << "not supported: no data: nifti_orientation";
  const json reference{{"type", "nifti"}, {"file", ras}};
  const View view = view_of(reference, 0.02, false);
  for (const std::string name : {"LAS", "LPI", "AIL", "SPR"})
    expect_same(view, reference, {{"type", "nifti"}, {"file", shared_data("nifti_orientation/" + name + ".nii.gz")}},
                name + ".nii.gz");
}

constexpr std::array<std::array<int, 3>, 4> orders{{{3, 1, 2}, {-2, 1, -3}, {2, -3, -1}, {-1, -2, -3}}};

std::string text_of(const std::array<int, 3>& order) {
  return std::to_string(order[0]) + " " + std::to_string(order[1]) + " " + std::to_string(order[2]);
}

// A smooth scan in an oblique, anisotropic grid, in LPS; steep along its first axis everywhere, so that normals are
// well defined and shaded pictures have a bound too.
json oblique_nrrd() {
  const std::string file = scratch("oblique.nrrd");
  const std::array<int, 3> n{26, 21, 17};
  std::ofstream out(file, std::ios::binary);
  out << "NRRD0004\ntype: float\ndimension: 3\nsizes: " << n[0] << ' ' << n[1] << ' ' << n[2]
      << "\nspace: left-posterior-superior\nspace directions: (0.96,0.64,0.16) (-0.6,1.1,0.5) (0.1,-0.7,1.7)\n"
      << "space origin: (-11.5,20.25,-7)\nencoding: raw\nendian: little\n\n";
  for (int k = 0; k < n[2]; ++k)
    for (int j = 0; j < n[1]; ++j)
      for (int i = 0; i < n[0]; ++i) {
        const double v = 4 * i + 18 * std::sin(0.21 * j + 0.4) + 15 * std::cos(0.25 * k) + 3 * std::sin(0.3 * i);
        const auto stored = static_cast<float>(v);
        out.write(reinterpret_cast<const char*>(&stored), sizeof stored);
      }
  return {{"type", "nrrd"}, {"file", file}};
}

TEST(Orientation, ObliqueNrrdInAnyOrder) {
  const json reference = oblique_nrrd();
  for (const bool shaded : {false, true}) {
    const View view = view_of(reference, 0.05, shaded);
    for (const auto& order : orders)
      expect_same(view, reference, reordered(*field_of(view, reference), order, true),
                  std::string(shaded ? "shaded, " : "") + "order " + text_of(order));
  }
}

TEST(Orientation, RotatedNrrd) {
  const std::string file = shared_data("volumes/flair_rotated.nrrd");
  if (file.empty()) GTEST_SKIP() << "not supported: no data: volumes/flair_rotated.nrrd";
  const json reference{{"type", "nrrd"}, {"file", file}};
  const View view = view_of(reference, 0.01, false);
  for (const auto& order : {orders[0], orders[2]})
    expect_same(view, reference, reordered(*field_of(view, reference), order, true),
                "flair_rotated, order " + text_of(order));
}

// The shipped series are one phantom, cut into axial and into sagittal slices.
TEST(Orientation, DicomAxialAndSagittal) {
  if (!have("dicom")) GTEST_SKIP() << "not supported: the dicom plugin is not built (libgdcm-dev)";
  const json axial{{"type", "dicom"}, {"file", shipped("dicom_torus")}, {"series", "2.25.1"}};
  const json sagittal{{"type", "dicom"}, {"file", shipped("dicom_torus")}, {"series", "2.25.2"}};
  expect_same(view_of(axial, 0.1, false), axial, sagittal, "dicom, axial and sagittal");
}

// The affine of the oblique series, computed by another program (pydicom) and written as NRRD in LPS.
TEST(Orientation, DicomSeriesAndNrrd) {
  if (!have("dicom")) GTEST_SKIP() << "not supported: the dicom plugin is not built (libgdcm-dev)";
  const std::string folder = shared_data("dicom_mr");
  if (folder.empty()) GTEST_SKIP() << "not supported: no data: dicom_mr";
  const json series{{"type", "dicom"}, {"file", folder}};
  const View view = view_of(series, 0.005, false);
  const auto grid = field_of(view, series);
  const std::string file = scratch("mr.nrrd");
  std::ofstream out(file, std::ios::binary);
  out << "NRRD0004\ntype: int16\ndimension: 3\nsizes: 256 256 18\nspace: left-posterior-superior\nspace directions: "
         "(0.859375,0,0) (0,0.85160625,0.11529203125) (0,-0.93529411764705883,6.9352941176470591)\n"
         "space origin: (-110.5,-79.3063,-65.7575)\nencoding: raw\nendian: little\n\n";
  out.write(static_cast<const char*>(grid->voxels.get()), static_cast<std::streamsize>(grid->bytes()));
  out.close();
  expect_same(view, series, {{"type", "nrrd"}, {"file", file}}, "dicom_mr and NRRD");
}

// The same voxels, stored by two formats. The NRRD file names an LPS space, so that its world is the vti file's with x
// and y negated; seen from the place that is turned with it the picture has the same bits.
TEST(Orientation, VtiAndNrrd) {
  const std::string file = shared_data("volumes/engine.vti");
  if (!have("vti")) GTEST_SKIP() << "not supported: the vti plugin is not built";
  if (file.empty()) GTEST_SKIP() << "not supported: no data: volumes/engine.vti";
  const json vti{{"type", "vti"}, {"file", file}}, nrrd{{"type", "nrrd"}, {"file", shipped("engine.nrrd")}};
  View view = view_of(nrrd, 0.02, false);
  const auto a = field_of(view, nrrd), b = field_of(view, vti);
  ASSERT_EQ(a->dims, b->dims);
  EXPECT_EQ(std::memcmp(a->voxels.get(), b->voxels.get(), a->bytes()), 0);
  const FrameImage reference = picture(view, nrrd);
  EXPECT_GT(differing_values(reference, picture(view, vti)), 0u);  // seen from the other side: the control
  json& camera = view.config["camera"];
  for (const char* key : {"position", "target"})
    for (const std::size_t axis : {0u, 1u}) camera[key][axis] = 0 - camera[key][axis].get<double>();
  EXPECT_EQ(differing_values(reference, picture(view, vti)), 0u);
}

}  // namespace
}  // namespace dvrlab::test
