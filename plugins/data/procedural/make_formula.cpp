#include "plugins/data/procedural/make_formula.h"

#include <cmath>
#include <nlohmann/json.hpp>
#include <numbers>

#include "framework/interfaces/error.h"

namespace dvrlab::procedural {
namespace {

Vector3 unit_direction(const ParameterSet& parameters) {
  const Vector3 d = parameters.vector3("direction");
  const double length = std::hypot(d[0], d[1], d[2]);
  if (!(length > 0)) throw InputError(parameters.path_of("direction") + ": is [0, 0, 0]; a direction has a length");
  return {d[0] / length, d[1] / length, d[2] / length};
}

std::vector<std::array<double, 4>> polyline_nodes(const ParameterSet& parameters) {
  const Nodes nodes = parameters.nodes("node");
  std::vector<std::array<double, 4>> out;
  for (const Node& n : nodes.node) {
    if (!out.empty() && !(n.value > out.back()[0]))
      throw InputError(parameters.path_of("node") + ": position " + std::to_string(n.value) +
                       " does not lie behind the one before; positions ascend strictly");
    if (!out.empty()) out.back()[2] = (n.x[0] - out.back()[1]) / (n.value - out.back()[0]);
    out.push_back({n.value, n.x[0], 0, 0});
  }
  if (out.empty())
    throw InputError(parameters.path_of("node") + ": the polyline has no nodes; give [[position, value], ...]");
  return out;
}

bool finite_numbers(const nlohmann::json& list, std::size_t count) {
  if (!list.is_array() || list.size() != count) return false;
  for (const auto& x : list)
    if (!x.is_number() || !std::isfinite(x.get<double>())) return false;
  return true;
}

}  // namespace

FormulaParams make_formula(const ParameterSet& parameters) {
  FormulaParams f;
  f.kind = static_cast<Kind>(parameters.choice_index("field"));
  auto &p0 = f.p[0], &p1 = f.p[1];
  const double offset = parameters.number("offset"), scale = parameters.number("scale");
  const auto around_center = [&] {
    const Vector3 c = parameters.vector3("center");
    p0 = {c[0], c[1], c[2], offset};
  };
  const auto along_direction = [&](double s, double w) {
    const Vector3 d = unit_direction(parameters);
    p0 = {s * d[0], s * d[1], s * d[2], w};
  };
  switch (f.kind) {
    case Kind::constant:
      p0[0] = parameters.number("value");
      break;
    case Kind::ramp:
      along_direction(scale, offset);
      break;
    case Kind::radial:
      around_center();
      p1[0] = scale;
      break;
    case Kind::sphere:
      around_center();
      p1 = {scale, 1 / parameters.number("radius"), 0, 0};
      break;
    case Kind::marschner_lobb: {
      const double alpha = parameters.number("alpha"), n = scale / (2 * (1 + alpha));
      p0 = {offset + n * (1 + alpha), -n, n * alpha, parameters.number("f_m")};
      break;
    }
    case Kind::sinusoid:
      along_direction(1, 0);
      p1 = {parameters.number("a"), parameters.number("b"), parameters.number("omega") / (2 * std::numbers::pi),
            parameters.number("phi") / (2 * std::numbers::pi)};
      break;
    case Kind::polynomial:
      p0 = {scale * 25 / 27, scale * -20 / 27, offset + scale * 12 / 27, 0};
      break;
    case Kind::polyline:
      along_direction(1, 0);
      f.node = polyline_nodes(parameters);
      break;
    case Kind::march_table:
      break;
  }
  return f;
}

Box read_bounds(const ParameterSet& parameters) {
  const nlohmann::json& bounds = parameters.json("bounds");
  const bool shaped =
      bounds.is_array() && bounds.size() == 2 && finite_numbers(bounds[0], 3) && finite_numbers(bounds[1], 3);
  Box box{};
  if (shaped) box = {bounds[0].get<Vector3>(), bounds[1].get<Vector3>()};
  if (!shaped || !(box.lo[0] < box.hi[0] && box.lo[1] < box.hi[1] && box.lo[2] < box.hi[2]))
    throw InputError(parameters.path_of("bounds") + ": " + bounds.dump() +
                     " is no box; give [[x, y, z], [x, y, z]], each number of the first below that of the second");
  return box;
}

std::array<double, 2> read_range(const ParameterSet& parameters, const std::array<double, 2>& fallback) {
  if (parameters.is_null("range")) return fallback;
  const nlohmann::json& range = parameters.json("range");
  if (!finite_numbers(range, 2) || !(range[0].get<double>() < range[1].get<double>()))
    throw InputError(parameters.path_of("range") + ": " + range.dump() + " is no range; give [lo, hi] with lo < hi");
  return range.get<std::array<double, 2>>();
}

}  // namespace dvrlab::procedural
