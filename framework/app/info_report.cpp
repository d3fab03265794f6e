#include "framework/app/info_report.h"

#include <algorithm>
#include <cmath>
#include <cstdio>

#include "framework/report/byte_text.h"
#include "framework/report/number_text.h"
#include "framework/report/text_table.h"
#include "framework/scene/orientation.h"
#include "framework/scene/vector.h"

namespace dvrlab {
namespace {

constexpr double quantiles[] = {0, 0.01, 0.05, 0.25, 0.5, 0.75, 0.95, 0.99, 0.999, 1};

const char* type_text(VoxelType type) {
  switch (type) {
    case VoxelType::u8:
      return "uint8";
    case VoxelType::i8:
      return "int8";
    case VoxelType::u16:
      return "uint16";
    case VoxelType::i16:
      return "int16";
    case VoxelType::f32:
      return "float32";
  }
  return "";
}

std::string by(const Vector3& v) { return number_text(v[0]) + " x " + number_text(v[1]) + " x " + number_text(v[2]); }
std::string point(const Vector3& v) {
  return "(" + number_text(v[0]) + ", " + number_text(v[1]) + ", " + number_text(v[2]) + ")";
}

/// World lengths of the field's box along its own axes.
Vector3 box_of(const Field& f) {
  Vector3 box;
  const auto axes = axis_directions(f);
  for (std::size_t a = 0; a < 3; ++a) box[a] = axes[a].spacing * (f.hi[a] - f.lo[a]);
  return box;
}

std::array<double, 2> range_of(const Field& f) {
  const double a = f.slope * f.stored_min + f.intercept, b = f.slope * f.stored_max + f.intercept;
  return {std::min(a, b), std::max(a, b)};
}

std::string world_words(const Field& f) {
  return f.anatomical
             ? "of a patient: x to the right, y to the front, z up (RAS); the axes point to " + orientation_code(f)
             : "no anatomy is known: the file's own axes";
}

/// Bars as long as the logarithm of the count: the background would hide the rest.
std::string bars(const Histogram& all, int bins) {
  constexpr double longest = 50;
  const Histogram h = all.merged(static_cast<std::size_t>(bins));
  const auto most = *std::max_element(h.count.begin(), h.count.end());
  std::vector<std::vector<std::string>> rows = {{"value", "voxels", "share", "bars: logarithm of the count"}};
  for (std::size_t b = 0; b < h.count.size(); ++b) {
    const double length = longest * std::log1p(static_cast<double>(h.count[b])) / std::log1p(static_cast<double>(most));
    char share[16];
    std::snprintf(share, sizeof share, "%.2f %%",
                  100.0 * static_cast<double>(h.count[b]) / static_cast<double>(h.total));
    rows.push_back({number_text(h.value(b)), std::to_string(h.count[b]), share,
                    std::string(static_cast<std::size_t>(std::lround(length)), '#')});
  }
  return text_table(rows);
}

}  // namespace

InfoReport make_info(LoadedData data) {
  InfoReport info;
  info.grid = dynamic_cast<const GridField*>(data.field.get());
  info.data = std::move(data);
  if (info.grid != nullptr) info.histogram = histogram_of(*info.grid);
  info.mesh = dynamic_cast<const MeshField*>(info.data.field.get());
  if (info.mesh != nullptr) info.summary = summary_of(*info.mesh);
  return info;
}

namespace {

std::vector<std::vector<std::string>> mesh_rows(const MeshField& mesh, const MeshSummary& s) {
  std::vector<std::vector<std::string>> rows;
  for (std::size_t k = 0; k < s.cells.size(); ++k)
    if (s.cells[k] > 0)
      rows.push_back({rows.empty() ? "cells" : "",
                      std::to_string(s.cells[k]) + " of the shape " + info_of(static_cast<CellShape>(k)).name});
  rows.push_back({"points", std::to_string(s.points)});
  rows.push_back({"boundary", std::to_string(s.boundary_faces) + " triangles, " + std::to_string(s.pieces) +
                                  (s.pieces == 1 ? " piece" : " pieces")});
  if (s.crowded_faces > 0)
    rows.push_back({"", std::to_string(s.crowded_faces) + (s.crowded_faces == 1 ? " face is" : " faces are") +
                            " shared by more than two cells"});
  rows.push_back({"walked as", std::to_string(s.tetrahedra) + " tetrahedra (sampler " + mesh.sampler + ")"});
  rows.push_back({"volume", number_text(s.volume)});
  rows.push_back({"quality", "mean ratio of the tetrahedra: " + number_text(s.least_quality, 3) + " at the least, " +
                                 number_text(s.median_quality, 3) + " in the median; " + std::to_string(s.poor) +
                                 " below 0.1"});
  if (s.bend > 0)
    rows.push_back({"bend", "middle nodes lie up to " + number_text(s.bend, 3) + " edge lengths beside their edge"});
  rows.push_back({"edges", number_text(mesh.voxel, 4) + " in the mean, the length unit \"voxel\""});
  return rows;
}

nlohmann::ordered_json mesh_json(const MeshField& mesh, const MeshSummary& s) {
  nlohmann::ordered_json cells = nlohmann::ordered_json::object();
  for (std::size_t k = 0; k < s.cells.size(); ++k)
    if (s.cells[k] > 0) cells[info_of(static_cast<CellShape>(k)).name] = s.cells[k];
  const MeshFaults& f = mesh.faults;
  return {{"cells", cells},
          {"points", s.points},
          {"tetrahedra", s.tetrahedra},
          {"boundary_faces", s.boundary_faces},
          {"crowded_faces", s.crowded_faces},
          {"pieces", s.pieces},
          {"volume", s.volume},
          {"quality", {{"least", s.least_quality}, {"median", s.median_quality}, {"below_0.1", s.poor}}},
          {"bend", s.bend},
          {"mean_edge", mesh.voxel},
          {"faults",
           {{"duplicate_cells", f.duplicate_cells},
            {"collapsed_cells", f.collapsed_cells},
            {"flat_cells", f.flat_cells},
            {"inverted_cells", f.inverted_cells},
            {"merged_points", f.merged_points},
            {"unused_points", f.unused_points}}}};
}

}  // namespace

std::string info_text(const InfoReport& info, int bins) {
  const Field& f = *info.data.field;
  const std::string unit = unit_text(f);
  std::vector<std::vector<std::string>> rows = {{"reader", info.data.type}};
  if (info.grid != nullptr) {
    const auto& d = info.grid->dims;
    rows.push_back({"grid", std::to_string(d[0]) + " x " + std::to_string(d[1]) + " x " + std::to_string(d[2]) +
                                " grid points, " + std::to_string(info.grid->count()) + " voxels"});
    rows.push_back({"stored as", std::string(type_text(info.grid->type)) + ", " + byte_text(info.grid->bytes())});
  } else if (info.mesh != nullptr) {
    for (auto& row : mesh_rows(*info.mesh, *info.summary)) rows.push_back(std::move(row));
  } else {
    rows.push_back({"grid", "none: the field is evaluated at every sample (sampler " + f.sampler + ")"});
  }
  const auto range = range_of(f);
  rows.push_back({"values", number_text(range[0]) + " to " + number_text(range[1])});
  if (info.mesh == nullptr && (f.slope != 1 || f.intercept != 0))
    rows.push_back({"scaling", "value = " + number_text(f.slope) + " * stored + " + number_text(f.intercept)});
  const auto axes = axis_directions(f);
  if (info.grid != nullptr) {
    rows.push_back({"spacing", by({axes[0].spacing, axes[1].spacing, axes[2].spacing}) + " " + unit});
  }
  rows.push_back(
      {"box", by(box_of(f)) + " " + unit + (info.mesh != nullptr ? "" : ", from the first to the last grid point")});
  rows.push_back(
      {info.mesh != nullptr ? "lowest corner" : "first point", point(f.to_world.point(f.lo)) + " in the world"});
  rows.push_back({"world", world_words(f)});
  for (int a = 0; a < 3 && info.mesh == nullptr; ++a)
    rows.push_back({a == 0 ? "axes" : "", axis_words(axes[static_cast<std::size_t>(a)], a, f.anatomical)});
  rows.push_back({"sha256", f.sha256.empty() ? "none: a formula" : f.sha256});
  for (std::size_t n = 0; n < f.notes.size(); ++n) rows.push_back({n == 0 ? "notes" : "", f.notes[n]});
  std::string text = f.source + "\n" + text_table(rows);
  if (!info.histogram) return text;
  const Histogram& h = *info.histogram;
  std::vector<std::vector<std::string>> shares = {{"share of voxels"}, {"have at most"}};
  for (double q : quantiles) {
    shares[0].push_back(number_text(100 * q) + " %");
    shares[1].push_back(number_text(h.quantile(q)));
  }
  return text + "\n" + text_table(shares) + "\n" + bars(h, bins);
}

nlohmann::ordered_json info_json(const InfoReport& info, int bins) {
  using Json = nlohmann::ordered_json;
  const Field& f = *info.data.field;
  const auto& m = f.to_world.m;
  Json axes = Json::array();
  const auto directions = axis_directions(f);
  for (int a = 0; a < 3; ++a) {
    const AxisDirection& d = directions[static_cast<std::size_t>(a)];
    axes.push_back({{"spacing", d.spacing},
                    {"direction", d.direction},
                    {"nearest", std::string(d.forwards ? "+" : "-") + "xyz"[d.world_axis]},
                    {"angle_deg", d.angle_deg},
                    {"words", axis_words(d, a, f.anatomical)}});
  }
  Json j = {{"source", f.source}, {"reader", info.data.type}, {"sampler", f.sampler}};
  if (info.grid != nullptr) {
    j["dims"] = info.grid->dims;
    j["voxels"] = info.grid->count();
    j["bytes"] = info.grid->bytes();
    j["stored_type"] = type_text(info.grid->type);
  }
  if (info.mesh != nullptr) j["mesh"] = mesh_json(*info.mesh, *info.summary);
  j["slope"] = f.slope;
  j["intercept"] = f.intercept;
  j["value_range"] = range_of(f);
  j["box"] = box_of(f);
  j["length_unit"] = f.length_unit;
  j["anatomical"] = f.anatomical;
  if (f.anatomical) j["orientation"] = orientation_code(f);
  j["axes"] = axes;
  j["affine"] = Json::array();
  for (std::size_t r = 0; r < 3; ++r) j["affine"].push_back({m[3 * r], m[3 * r + 1], m[3 * r + 2], f.to_world.t[r]});
  j["sha256"] = f.sha256;
  j["notes"] = f.notes;
  if (!info.histogram) return j;
  const Histogram& h = *info.histogram;
  j["quantiles"] = Json::array();
  for (double q : quantiles) j["quantiles"].push_back({{"share", q}, {"value", h.quantile(q)}});
  const Histogram merged = h.merged(static_cast<std::size_t>(bins));
  j["histogram"] = {
      {"exact", h.exact}, {"first_bin_centre", merged.first}, {"bin_width", merged.step}, {"count", merged.count}};
  return j;
}

}  // namespace dvrlab
