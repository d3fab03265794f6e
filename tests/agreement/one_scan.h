// Two files of one scan must give one picture: views in world coordinates, a bound of what rounding may change, and
// files that hold a scan in another order of its voxels.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <string>

#include "framework/interfaces/field.h"
#include "tests/support/render.h"

namespace dvrlab::test {

/// What the pictures of one scan share, all of it in world units and physical values.
struct View {
  nlohmann::json config;  // without the data
  double step = 0;        // voxels
  double opacity = 0;     // of the largest value, over one voxel; 0 at the smallest, the extinction linear between
  bool shaded = false;
};

/// Looks at the scan from the right, the front and above, on the cpu backend.
View view_of(const nlohmann::json& data, double opacity, bool shaded);
FrameImage picture(const View& view, const nlohmann::json& data);
std::shared_ptr<const GridField> field_of(const View& view, const nlohmann::json& data);

/// The largest difference that rounding can make between two pictures of one scan; derived in one_scan.cpp.
double bound_of(const View& view, const GridField& a, const GridField& b);

/// Writes a grid as NRRD in another order: axis c of the file is axis |order[c]| - 1 of the grid, backwards where
/// order[c] is negative. The affine follows unless `turned` is false, which is a file that lies. Returns the config's
/// data section.
nlohmann::json reordered(const GridField& grid, const std::array<int, 3>& order, bool turned);

/// Same picture within the bound; the negative control: a scan that is mirrored along one axis is far beyond it.
void expect_same(const View& view, const nlohmann::json& a, const nlohmann::json& b, const std::string& what);

/// A path in a folder of this test process, which is removed at its end.
std::string scratch(const std::string& name);

}  // namespace dvrlab::test
