#include "plugins/data/nrrd/nrrd_geometry.h"

#include <algorithm>
#include <cmath>

namespace dvrlab::nrrd {
namespace {

constexpr long long most_axes = 16;  // of the format

constexpr const char* what_to_do = "; only one 3-D scalar volume is read: cut out one volume or one component first";

// Signs that turn the named space into RAS. Spaces without anatomy stay as they are.
Vector3 read_space(const NrrdText& text, GridFile& file) {
  if (const auto count = text.find("space dimension"); count && *count != "3")
    text.fail("space dimension", "is " + *count + "; the space of a volume has 3");
  const std::string space = lower_case(text.find("space").value_or(""));
  file.anatomical = true;
  if (space == "left-posterior-superior" || space == "lps") {
    file.notes.push_back("world frame: RAS, the file's LPS coordinates with x and y negated");
    return {-1, -1, 1};
  }
  if (space == "left-anterior-superior" || space == "las") {
    file.notes.push_back("world frame: RAS, the file's LAS coordinates with x negated");
    return {-1, 1, 1};
  }
  if (space == "right-anterior-superior" || space == "ras") return {1, 1, 1};
  file.anatomical = false;
  if (!space.empty() && space != "scanner-xyz" && space != "3d-right-handed" && space != "3d-left-handed")
    text.fail("space", "\"" + space + "\" is no space of three dimensions");
  file.notes.push_back("world frame: the file's own coordinates; it names no anatomical space");
  return {1, 1, 1};
}

// `space units` speak of the space's axes, `units` of the grid's. One unit for all of them, or none.
std::string read_unit(const NrrdText& text, const Axes& axes, bool directions, GridFile& file) {
  const char* field = directions ? "space units" : "units";
  std::vector<std::string> units = text.quoted_texts(field);
  if (units.empty()) return "";
  const std::size_t count = directions ? 3 : axes.declared;
  if (units.size() != count)
    text.fail(field, "has " + std::to_string(units.size()) + " texts, not " + std::to_string(count));
  std::vector<std::string> kept;
  for (std::size_t c = 0; c < 3; ++c) kept.push_back(units[directions ? c : axes.kept[c]]);
  if (kept[0] == kept[1] && kept[1] == kept[2]) return kept[0];
  file.notes.push_back(std::string("`") + field + "` differ between the axes and are not applied");
  return "";
}

}  // namespace

Axes read_axes(const NrrdText& text, GridFile& file) {
  const long long dimension = text.integers("dimension", 1)[0];
  if (dimension < 3 || dimension > most_axes) text.fail("dimension", "is " + std::to_string(dimension) + what_to_do);
  Axes axes{static_cast<std::size_t>(dimension), {}};
  const auto sizes = text.integers("sizes", axes.declared);
  std::vector<std::string> kinds = text.words("kinds");
  if (!kinds.empty() && kinds.size() != axes.declared)
    text.fail("kinds", "has " + std::to_string(kinds.size()) + " words, not " + std::to_string(axes.declared));
  kinds.resize(axes.declared, "???");
  for (std::size_t a = 0; a < axes.declared; ++a) {
    if (sizes[a] == 1 && dimension > 3)
      file.notes.push_back("axis " + std::to_string(a + 1) + " of size 1 (kind " + kinds[a] + ") was dropped");
    else
      axes.kept.push_back(a);
  }
  if (axes.kept.size() != 3)
    text.fail("dimension", "is " + std::to_string(dimension) + ", and " + std::to_string(axes.kept.size()) +
                               " axes are longer than 1" + what_to_do);
  for (std::size_t c = 0; c < 3; ++c) {
    const std::string kind = lower_case(kinds[axes.kept[c]]);
    if (kind != "domain" && kind != "space" && kind != "none" && kind != "???")
      text.fail("kinds", "an axis of kind " + quoted(kinds[axes.kept[c]]) + " does not lie in space" + what_to_do);
    file.dims[c] = sizes[axes.kept[c]];
  }
  return axes;
}

void read_geometry(const NrrdText& text, const Axes& axes, GridFile& file) {
  auto& notes = file.notes;
  const auto directions = text.vectors("space directions", axes.declared);
  const auto given = text.numbers("spacings", axes.declared);
  if (directions.empty() && given.empty()) notes.push_back("the file has no spacing: 1 along each axis");
  if (!directions.empty() && !given.empty()) notes.push_back("`space directions` are used, `spacings` are not");
  if (directions.empty() && (text.find("axis mins") || text.find("axis maxs")))
    notes.push_back("`axis mins` and `axis maxs` are not used");
  for (std::size_t c = 0; c < 3; ++c) {
    const std::size_t axis = axes.kept[c];
    double spacing = given.empty() ? 1 : given[axis];
    if (std::isnan(spacing)) {
      if (directions.empty()) notes.push_back("an unknown spacing (nan) is taken as 1");
      spacing = 1;
    }
    if (directions.empty() && spacing == 0)
      text.fail("spacings", "is 0 along axis " + std::to_string(axis + 1) + "; a spacing is another number");
    if (!directions.empty() && directions[axis] == Vector3{0, 0, 0})
      text.fail("space directions", "axis " + std::to_string(axis + 1) + " is (0,0,0); an axis has a direction");
    if (!directions.empty() && !directions[axis])
      text.fail("space directions",
                "axis " + std::to_string(axis + 1) + " is \"none\"; each axis of a volume has a vector \"(x,y,z)\"");
    for (std::size_t r = 0; r < 3; ++r)
      file.to_world.m[3 * r + c] = directions.empty() ? (r == c ? spacing : 0) : (*directions[axis])[r];
  }
  if (const auto origin = text.vectors("space origin", 1); !origin.empty()) {
    if (!origin[0]) text.fail("space origin", "is \"none\"; a volume's first voxel has a place \"(x,y,z)\"");
    file.to_world.t = *origin[0];
  }
  flip_world(file.to_world, read_space(text, file));
  file.length_unit = read_unit(text, axes, !directions.empty(), file);
}

}  // namespace dvrlab::nrrd
