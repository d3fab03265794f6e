// Fields that are formulas: on a grid of stated size and type, or evaluated at every sample (formula sampler).
#include <algorithm>
#include <cmath>

#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/interfaces/mesh_keys.h"
#include "framework/scene/buffers.h"
#include "framework/scene/sha256.h"
#include "framework/scene/voxels.h"
#include "plugins/data/procedural/fill_grid.h"
#include "plugins/data/procedural/fill_mesh.h"

namespace dvrlab::procedural {
namespace {

using enum ParameterType;

constexpr Parameter mesh_normals_key_of_procedural = [] {
  Parameter key = mesh_normals_key;
  key.only_with = "evaluate=mesh";
  key.live_in =
      R"({"data":{"evaluate":"mesh","size":[5,5,5]},"optical_model":{"shaded":true},"estimator":{"type":"direct"},"illumination":[{"type":"blinn_phong"}]})";
  return key;
}();

constexpr Parameter mesh_tolerance_key_of_procedural = [] {
  Parameter key = mesh_tolerance_key;
  key.only_with = "evaluate=mesh";
  key.live_in = R"({"data":{"evaluate":"mesh","size":[5,5,5],"cells":"hexahedra"},"estimator":{"type":"average"}})";
  return key;
}();

constexpr Parameter parameters[] = {
    {"field", choice, "", R"("marschner_lobb")",
     "constant|ramp|radial|sphere|marschner_lobb|sinusoid|polynomial|polyline|march_table",
     "The formula; the keys that it reads stand in the documentation.", Affects::pixels, "{}", R"("sphere")"},
    {"evaluate", choice, "", R"("grid")", "grid|formula|mesh",
     "On a grid of voxels, exactly at every sample, or at the points of an unstructured mesh.", Affects::pixels, "{}",
     R"("formula")"},
    {"cells", choice, "", R"("tetrahedra6")",
     "tetrahedra5|tetrahedra6|hexahedra|wedges|pyramids|tetrahedra10|hexahedra20|wedges15",
     "Into what each brick between eight grid points is cut; tetrahedra10, hexahedra20 and wedges15 are quadratic.",
     Affects::pixels, R"({"data":{"evaluate":"mesh","size":[5,5,5]}})", R"("tetrahedra5")", "evaluate=mesh"},
    {"jitter", number, "spacing", "0", "[0,0.5)",
     "How far points that are not on the surface of the box move at the most, on each axis.", Affects::pixels,
     R"({"data":{"evaluate":"mesh","size":[5,5,5]}})", "0.2", "evaluate=mesh"},
    {"jitter_seed", integer, "", "1", "[0,4294967295]", "Which of the ways to move them.", Affects::pixels,
     R"({"data":{"evaluate":"mesh","size":[5,5,5],"jitter":0.2}})", "2", "evaluate=mesh"},
    mesh_normals_key_of_procedural,
    mesh_tolerance_key_of_procedural,
    {"bounds", json, "world", "[[-1,-1,-1],[1,1,1]]", "", "Lower and upper corner of the box, [[x,y,z],[x,y,z]].",
     Affects::pixels, "{}", "[[-1,-1,-1],[1,1,0.5]]", "",
     R"({"type":"array","minItems":2,"maxItems":2,"items":{"type":"array","minItems":3,"maxItems":3,"items":{"type":"number"}}})"},
    {"size", integer3, "voxels", "[64,64,64]", "[2,16384]",
     "Grid points along each axis; for a formula it only sets the length unit `voxel`.", Affects::pixels, "{}",
     "[33,30,28]"},
    {"voxel_type", choice, "", R"("float32")", "uint8|int8|uint16|int16|float32", "Type of the voxels of a grid.",
     Affects::pixels, "{}", R"("uint8")"},
    {"range", json, "value", "null", "",
     "Integer types: values [lo, hi] of the smallest and the largest stored number; null: the range of the formula.",
     Affects::pixels, R"({"data":{"voxel_type":"uint8"}})", "[0.2,0.6]", "",
     R"({"type":["array","null"],"minItems":2,"maxItems":2,"items":{"type":"number"}})"},
    {"placement", choice, "", R"("points")", "points|cell_centres",
     "Grid points from bound to bound, or in the middle of the cells that fill the bounds.", Affects::pixels, "{}",
     R"("cell_centres")"},
    {"value", number, "value", "0.5", "", "constant: the value.", Affects::pixels, R"({"data":{"field":"constant"}})",
     "0.8", "field=constant"},
    {"direction", vector3, "", "[1,0,0]", "", "ramp, sinusoid, polyline: the direction in which the field varies.",
     Affects::pixels, R"({"data":{"field":"ramp"}})", "[0,1,1]", "field=ramp|sinusoid|polyline"},
    {"offset", number, "value", "0", "", "ramp, radial, sphere, marschner_lobb, polynomial: added to the field.",
     Affects::pixels, R"({"data":{"field":"ramp"}})", "0.25", "field=ramp|radial|sphere|marschner_lobb|polynomial"},
    {"scale", number, "value", "1", "",
     "ramp, radial: change per world unit; sphere, marschner_lobb, polynomial: factor of the field.", Affects::pixels,
     R"({"data":{"field":"ramp"}})", "0.5", "field=ramp|radial|sphere|marschner_lobb|polynomial"},
    {"center", vector3, "world", "[0,0,0]", "", "radial, sphere: the centre.", Affects::pixels,
     R"({"data":{"field":"radial"}})", "[0.3,0,0]", "field=radial|sphere"},
    {"radius", number, "world", "1", "(0,inf)", "sphere: where the value has fallen to `offset`.", Affects::pixels,
     R"({"data":{"field":"sphere"}})", "0.6", "field=sphere"},
    {"alpha", number, "", "0.25", "[0,inf)", "marschner_lobb: weight of the rings.", Affects::pixels, "{}", "0.6",
     "field=marschner_lobb"},
    {"f_m", number, "1/world", "6", "[0,inf)", "marschner_lobb: frequency of the rings.", Affects::pixels, "{}", "3",
     "field=marschner_lobb"},
    {"a", number, "value", "0.5", "", "sinusoid: mean.", Affects::pixels, R"({"data":{"field":"sinusoid"}})", "0.4",
     "field=sinusoid"},
    {"b", number, "value", "0.5", "", "sinusoid: amplitude.", Affects::pixels, R"({"data":{"field":"sinusoid"}})",
     "0.3", "field=sinusoid"},
    {"omega", number, "radian/world", "6.283185307179586", "", "sinusoid: angular frequency.", Affects::pixels,
     R"({"data":{"field":"sinusoid"}})", "4", "field=sinusoid"},
    {"phi", number, "radian", "0", "", "sinusoid: phase.", Affects::pixels, R"({"data":{"field":"sinusoid"}})", "1",
     "field=sinusoid"},
    {"node", nodes, "world, value", "[[-1,0],[1,1]]", "1",
     "polyline: [[position, value], ...] along `direction`, ascending; constant outside.", Affects::pixels,
     R"({"data":{"field":"polyline"}})", "[[-1,0],[0,0.8],[1,0.1]]", "field=polyline"},
};

constexpr VoxelType voxel_types[] = {VoxelType::u8, VoxelType::i8, VoxelType::u16, VoxelType::i16, VoxelType::f32};

std::array<long long, 3> sizes(const ParameterSet& p) {
  const auto size = p.integer3("size");
  return {size[0], size[1], size[2]};
}

std::string describe(const ParameterSet& p) { return "procedural " + p.text("field") + ", " + p.text("evaluate"); }

std::shared_ptr<const Field> formula_field(const FormulaParams& f, const Box& box, const ParameterSet& p) {
  auto field = std::make_shared<FormulaField>();
  field->sampler = "formula";
  field->lo = box.lo;
  field->hi = box.hi;
  const auto size = sizes(p);
  field->voxel = (box.hi[0] - box.lo[0]) / static_cast<double>(size[0] - 1);
  for (std::size_t a = 1; a < 3; ++a)
    field->voxel = std::min(field->voxel, (box.hi[a] - box.lo[a]) / static_cast<double>(size[a] - 1));
  const auto [lo, hi] = range(f, box.lo, box.hi);
  field->stored_min = lo;
  field->stored_max = hi;
  field->source = describe(p);
  const auto vector = [&](const char* name, const std::array<double, 4>& x) {
    field->uniforms.push_back(Uniform::vector(name, x[0], x[1], x[2], x[3]));
  };
  field->uniforms.push_back(Uniform::constant_integer("formula_kind", static_cast<int>(f.kind)));
  field->uniforms.push_back(Uniform::integer("formula_count", static_cast<int>(f.node.size())));
  vector("formula_p0", f.p[0]);
  vector("formula_p1", f.p[1]);
  std::vector<double> nodes;
  for (const auto& n : f.node) nodes.insert(nodes.end(), {n[0], n[1], n[2], 0.0});
  field->buffers.push_back(vec4_buffer("formula_nodes", std::move(nodes)));
  return field;
}

MeshPlan mesh_plan(const ParameterSet& p) {
  return {p.integer3("size"), read_bounds(p), static_cast<BoxCells>(p.choice_index("cells")), p.number("jitter"),
          static_cast<std::uint32_t>(p.integer("jitter_seed"))};
}

std::shared_ptr<const Field> mesh_field(const FormulaParams& f, const ParameterSet& p, const LoadContext& context) {
  auto mesh = std::make_shared<MeshField>(fill_mesh(f, mesh_plan(p)));
  mesh->source = describe(p) + " of " + p.text("cells");
  mesh->gradient = mesh_gradient(p);
  mesh->tolerance = p.number("tolerance");
  mesh->sha256 = sha256({std::as_bytes(std::span(mesh->point)), std::as_bytes(std::span(mesh->value)),
                         std::as_bytes(std::span(mesh->node))});
  finish_mesh(*mesh, context.nan_policy, context.nan_value);
  return mesh;
}

class Procedural : public DataPlugin {
 public:
  void check(const ParameterSet& p) const override {
    const FormulaParams f = make_formula(p);
    const Box box = read_bounds(p);
    read_range(p, range(f, box.lo, box.hi));
    if (f.kind == Kind::march_table && p.text("evaluate") != "grid")
      throw InputError(p.path_of("evaluate") + ": march_table is defined on a grid only; set it to \"grid\"");
    grid_bytes(sizes(p), bytes_of(voxel_types[p.choice_index("voxel_type")]), p.path_of("size"));
  }

  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const override {
    const FormulaParams f = make_formula(p);
    const Box box = read_bounds(p);
    if (p.text("evaluate") == "formula") return formula_field(f, box, p);
    if (p.text("evaluate") == "mesh") return mesh_field(f, p, context);
    const auto grid = std::make_shared<GridField>(
        fill_grid(f, {p.integer3("size"), voxel_types[p.choice_index("voxel_type")], box,
                      p.text("placement") == "cell_centres", read_range(p, range(f, box.lo, box.hi))}));
    grid->source = describe(p);
    grid->sha256 = sha256({{static_cast<const std::byte*>(grid->voxels.get()), grid->bytes()}});
    finish_grid(*grid, context.nan_policy, context.nan_value);
    return grid;
  }

  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext&) const override {
    const std::uint64_t bytes =
        grid_bytes(sizes(p), bytes_of(voxel_types[p.choice_index("voxel_type")]), p.path_of("size"));
    if (p.text("evaluate") == "mesh") return mesh_bytes(mesh_plan(p));
    return p.text("evaluate") == "formula" ? 0 : bytes;
  }
};

}  // namespace

DVRLAB_PLUGIN("data", "procedural", "1.0.0", Procedural, parameters,
              "Fields given by a formula, on a grid or evaluated at every sample, with exact values and gradients.",
              "Marschner and Lobb, IEEE Visualization 1994, doi:10.1109/VISUAL.1994.346331 (marschner_lobb)")

}  // namespace dvrlab::procedural
