#include "tests/spike/tets.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include "framework/scene/buffers.h"

namespace dvrlab::spike {
namespace {

Vector3 minus(const Vector3& a, const Vector3& b) { return {a[0] - b[0], a[1] - b[1], a[2] - b[2]}; }
double dot(const Vector3& a, const Vector3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vector3 cross(const Vector3& a, const Vector3& b) {
  return {a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]};
}

struct Tets {
  std::vector<double> plane, field;
  std::vector<std::int32_t> neighbour;
  std::map<std::array<Vector3, 3>, std::size_t> open;  // faces that have one side so far
  double least = std::numeric_limits<double>::max(), most = std::numeric_limits<double>::lowest();

  void add(const std::array<Vector3, 4>& vertex, const std::function<double(const Vector3&)>& value) {
    const std::size_t cell = field.size() / 4;
    Vector3 gradient{0, 0, 0};
    for (std::size_t f = 0; f < 4; ++f) {
      std::array<Vector3, 3> face{vertex[(f + 1) % 4], vertex[(f + 2) % 4], vertex[(f + 3) % 4]};
      Vector3 normal = cross(minus(face[1], face[0]), minus(face[2], face[0]));
      const double height = dot(normal, minus(vertex[f], face[0]));  // of the opposite vertex, times twice the area
      const double v = value(vertex[f]);
      least = std::min(least, v);
      most = std::max(most, v);
      for (std::size_t c = 0; c < 3; ++c) gradient[c] += v * normal[c] / height;
      const double length = std::copysign(std::sqrt(dot(normal, normal)), -height);
      for (double& x : normal) x /= length;
      plane.insert(plane.end(), {normal[0], normal[1], normal[2], dot(normal, face[0])});
      std::sort(face.begin(), face.end());
      neighbour.push_back(-1);
      const auto [known, is_new] = open.emplace(face, 4 * cell + f);
      if (!is_new) {
        neighbour.back() = std::int32_t(known->second / 4);
        neighbour[known->second] = std::int32_t(cell);
      }
    }
    field.insert(field.end(), {gradient[0], gradient[1], gradient[2], value(vertex[0]) - dot(gradient, vertex[0])});
  }
};

}  // namespace

std::shared_ptr<const Field> make_tets(const TetBlock& block) {
  Tets tets;
  const auto corner = [&](const std::array<int, 3>& i) {
    Vector3 p;
    for (std::size_t c = 0; c < 3; ++c) p[c] = block.lo[c] + (block.hi[c] - block.lo[c]) * i[c] / block.boxes[c];
    return p;
  };
  for (int k = 0; k < block.boxes[2]; ++k)
    for (int j = 0; j < block.boxes[1]; ++j)
      for (int i = 0; i < block.boxes[0]; ++i) {
        if (!block.keep(i, j, k)) continue;
        std::array<std::size_t, 3> axis{0, 1, 2};  // a tetrahedron per order of the axes: a path from corner to corner
        do {
          std::array<int, 3> at{i, j, k};
          std::array<Vector3, 4> vertex{corner(at)};
          for (std::size_t step = 0; step < 3; ++step) {
            ++at[axis[step]];
            vertex[step + 1] = corner(at);
          }
          tets.add(vertex, block.value);
        } while (std::next_permutation(axis.begin(), axis.end()));
      }
  auto field = std::make_shared<FormulaField>();
  field->sampler = "spike_tets";
  field->source = "tetrahedra of a test";
  field->lo = block.lo;
  field->hi = block.hi;
  field->stored_min = tets.least;
  field->stored_max = tets.most;
  const std::uint64_t count = tets.neighbour.size();
  field->uniforms = {Uniform::integer("spike_tets_count", int(tets.field.size() / 4))};
  field->buffers = {vec4_buffer("spike_tets_plane", tets.plane), vec4_buffer("spike_tets_field", tets.field),
                    make_buffer("spike_tets_neighbour", Element::i32, tets.neighbour, count)};
  return field;
}

}  // namespace dvrlab::spike
