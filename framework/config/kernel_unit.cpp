#include "framework/interfaces/kernel_unit.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <stdexcept>

namespace dvrlab {

namespace {
bool text_has(const KernelUnit& sampler, const char* word) {
  const std::string file = sampler.folder + "/" + sampler.plugin + ".kernel";
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read the kernel text " + file);
  const std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  return text.find(word) != std::string::npos;
}
}  // namespace

bool walks(const KernelUnit& sampler) { return text_has(sampler, "walk_next("); }
bool tells_cells(const KernelUnit& sampler) { return text_has(sampler, "sample_cell("); }

Uniform Uniform::real(std::string name, double value) {
  Uniform u;
  u.name = std::move(name);
  u.type = Type::f32;
  u.f[0] = value;
  return u;
}

Uniform Uniform::integer(std::string name, int value) {
  Uniform u;
  u.name = std::move(name);
  u.type = Type::i32;
  u.i = value;
  return u;
}

Uniform Uniform::constant_integer(std::string name, int value) {
  Uniform u = integer(std::move(name), value);
  u.constant = true;
  return u;
}

Uniform Uniform::vector(std::string name, double x, double y, double z, double w) {
  Uniform u;
  u.name = std::move(name);
  u.type = Type::vec4;
  u.f = {x, y, z, w};
  return u;
}

std::size_t bytes_of(Element e) {
  switch (e) {
    case Element::u8:
    case Element::i8:
      return 1;
    case Element::u16:
    case Element::i16:
      return 2;
    case Element::f32:
    case Element::i32:
      return 4;
    case Element::vec4:
    case Element::ivec4:
      return 16;
  }
  return 0;
}

std::vector<Uniform> uniforms_of(const std::string& plugin, const ParameterSet& parameters) {
  std::vector<Uniform> uniforms;
  for (const Parameter& p : parameters.declared()) {
    std::string name = plugin + "_" + p.name;
    std::replace(name.begin(), name.end(), '.', '_');
    switch (p.type) {
      case ParameterType::boolean:
        uniforms.push_back(Uniform::constant_integer(name, parameters.boolean(p.name) ? 1 : 0));
        break;
      case ParameterType::integer:
        // A constant: lavapipe (Mesa 22.3) reads outside its arrays where a uniform bounds a loop.
        uniforms.push_back(Uniform::constant_integer(name, static_cast<int>(parameters.integer(p.name))));
        break;
      case ParameterType::number:
        uniforms.push_back(Uniform::real(name, parameters.number(p.name)));
        break;
      case ParameterType::choice:
        uniforms.push_back(Uniform::constant_integer(name, parameters.choice_index(p.name)));
        break;
      case ParameterType::vector3: {
        const Vector3 v = parameters.vector3(p.name);
        uniforms.push_back(Uniform::vector(name, v[0], v[1], v[2]));
        break;
      }
      case ParameterType::integer3: {
        const std::array<int, 3> v = parameters.integer3(p.name);
        uniforms.push_back(Uniform::vector(name, v[0], v[1], v[2]));
        break;
      }
      case ParameterType::text:
      case ParameterType::nodes:
      case ParameterType::json:
        break;  // the plugin's own affair
    }
  }
  return uniforms;
}

}  // namespace dvrlab
