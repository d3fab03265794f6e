// Scattered samples as a mesh: Delaunay's tetrahedra.
#include <algorithm>
#include <cmath>
#include <filesystem>

#include "framework/interfaces/error.h"
#include "framework/interfaces/mesh_keys.h"
#include "framework/scene/mapped_file.h"
#include "framework/scene/sha256.h"
#include "plugins/data/points/delaunay.h"
#include "plugins/data/points/sample_text.h"

namespace dvrlab::points {
namespace {

constexpr Parameter parameters[] = {
    {"file", ParameterType::text, "", nullptr, "",
     "Text of one sample per line, x y z ... value, separated by blanks, commas or semicolons; relative to the "
     "config's folder; "
     "${NAME} reads the environment.",
     Affects::pixels, "{}", R"("../../../data/samples_b.csv")"},
    {"column", ParameterType::integer, "", "3", "[3,1000000]", "Column of the value, from 0; the places are 0 to 2.",
     Affects::pixels, "{}", "4"},
    {"max_edge", ParameterType::number, "world", "0", "[0,inf)",
     "Tetrahedra with a longer edge are left out, so that hollows of the samples stay hollow; 0: none are.",
     Affects::pixels, "{}", "0.6"},
    mesh_normals_key};

class Points : public DataPlugin {
 public:
  bool recognises(const std::string& path, std::span<const std::byte>) const override {
    std::string end = std::filesystem::path(path).extension().string();
    std::transform(end.begin(), end.end(), end.begin(), [](unsigned char c) { return std::tolower(c); });
    return end == ".xyz";
  }

  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const override {
    const std::string name = resolve_path(p.text("file"), context, p.path_of("file"));
    const auto file = MappedFile::open(name);
    Samples s = read_samples(file->bytes(), p.integer("column"), name);
    for (std::size_t k = 0; k < s.place.size(); ++k)
      for (const double x : s.place[k])
        if (!std::isfinite(x))
          throw InputError(name + ": sample " + std::to_string(k) + ": a coordinate is not finite");
    const auto mesh = std::make_shared<MeshField>();
    mesh->source = name;
    mesh->sha256 = sha256({file->bytes()});
    mesh->gradient = mesh_gradient(p);
    mesh->notes.push_back("world frame: the file's own coordinates");
    const double longest = p.number("max_edge");
    std::uint64_t left_out = 0;
    for (const auto& cell : delaunay(s.place, name)) {
      if (longest > 0 && longest_edge(s.place, cell) > longest)
        ++left_out;
      else
        mesh->add_cell(CellShape::tetrahedron, cell);
    }
    mesh->point = std::move(s.place);
    mesh->value = std::move(s.value);
    mesh->notes.push_back(std::to_string(mesh->cells()) + " tetrahedra of Delaunay between " +
                          std::to_string(mesh->point.size()) + " samples (Qhull)");
    if (left_out > 0) mesh->notes.push_back(std::to_string(left_out) + " tetrahedra are left out for their long edges");
    finish_mesh(*mesh, context.nan_policy, context.nan_value);
    return mesh;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext& context) const override {
    const auto file = MappedFile::open(resolve_path(p.text("file"), context, p.path_of("file")));
    // A sample is 8 characters at the least; about 7 tetrahedra each, for which Qhull takes some 400 bytes.
    return file->bytes().size() / 8 * (32 + 7 * 450);
  }

 private:
  static double longest_edge(const std::vector<Vector3>& p, const std::array<std::uint32_t, 4>& cell) {
    double longest = 0;
    for (std::size_t a = 0; a < 4; ++a)
      for (std::size_t b = a + 1; b < 4; ++b) {
        const Vector3 &x = p[cell[a]], &y = p[cell[b]];
        longest = std::max(longest, std::hypot(x[0] - y[0], x[1] - y[1], x[2] - y[2]));
      }
    return longest;
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "points", "1.0.0", Points, parameters,
              "Samples at scattered places from a text file, joined by Delaunay's tetrahedra.",
              "C. Barber, D. Dobkin, H. Huhdanpaa, The Quickhull Algorithm for Convex Hulls, ACM TOMS 22(4), 1996, "
              "doi:10.1145/235815.235821")

}  // namespace dvrlab::points
