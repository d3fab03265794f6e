#include "plugins/data/vti/vti_header.h"

#include <algorithm>

#include "framework/interfaces/error.h"

namespace dvrlab::vti {
namespace {

using vtk_xml::Attributes;

Extent extent_of(const Attributes& element, const std::string& attribute) {
  const auto numbers = element.integers(attribute, 6);
  Extent extent;
  std::copy_n(numbers.begin(), 6, extent.begin());
  return extent;
}

class Reader : public vtk_xml::FileReader {
 public:
  Reader(std::span<const std::byte> file, const std::string& name, VtiHeader& header)
      : FileReader(file, name, header), name_(name), header_(header) {}

  void finish() const {
    if (!grid_) throw InputError(name_ + ": holds no <ImageData>");
    if (header_.pieces.empty()) throw InputError(name_ + ": <ImageData> holds no <Piece>");
  }

 private:
  void check_type(const std::string& type, const Attributes& a) override {
    if (type == "PImageData")
      a.fail("type is \"PImageData\", a list of other files; name one of these, or store the volume as one .vti file");
    if (type != "ImageData") a.fail("type is \"" + type + "\"; only ImageData, a regular grid, is read");
  }

  std::vector<DataArray>* arrays_at(const std::string& path) override {
    return path == "/VTKFile/ImageData/Piece/PointData/DataArray" ? &header_.pieces.back().arrays : nullptr;
  }

  void element(const std::string& path, const Attributes& a) override {
    if (path == "/VTKFile/ImageData") {
      read_grid(a);
    } else if (path == "/VTKFile/ImageData/Piece") {
      header_.pieces.push_back({extent_of(a, "Extent"), "", {}, 0});
    } else if (path == "/VTKFile/ImageData/Piece/PointData") {
      header_.pieces.back().scalars = a.text("Scalars", "");
    } else if (path == "/VTKFile/ImageData/Piece/CellData/DataArray") {
      ++header_.pieces.back().cell_arrays;
    }
  }

  void read_grid(const Attributes& a) {
    if (grid_) a.fail("stands twice");
    grid_ = true;
    header_.whole = extent_of(a, "WholeExtent");
    auto origin = a.numbers("Origin", 3), spacing = a.numbers("Spacing", 3), direction = a.numbers("Direction", 9);
    origin.resize(3, 0);
    if (spacing.empty()) spacing = {1, 1, 1};
    if (std::count(spacing.begin(), spacing.end(), 0) > 0) a.fail("Spacing holds a 0; a spacing is another number");
    if (direction.empty()) direction = {1, 0, 0, 0, 1, 0, 0, 0, 1};
    Affine& affine = header_.to_world;
    for (std::size_t r = 0; r < 3; ++r)
      for (std::size_t c = 0; c < 3; ++c) affine.m[3 * r + c] = direction[3 * r + c] * spacing[c];
    // Origin is the place of point (0, 0, 0), which need not lie in the extent.
    const Extent& x = header_.whole;
    affine.t = {origin[0], origin[1], origin[2]};
    affine.t = affine.point({static_cast<double>(x[0]), static_cast<double>(x[2]), static_cast<double>(x[4])});
  }

  const std::string& name_;
  VtiHeader& header_;
  bool grid_ = false;
};

}  // namespace

std::array<long long, 3> dims_of(const Extent& x) { return {x[1] - x[0] + 1, x[3] - x[2] + 1, x[5] - x[4] + 1}; }

VtiHeader read_header(std::span<const std::byte> file, const std::string& name) {
  VtiHeader header;
  Reader reader(file, name, header);
  scan_xml(file, name, reader);
  reader.finish();
  return header;
}

}  // namespace dvrlab::vti
