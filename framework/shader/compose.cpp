#include "framework/shader/compose.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <stdexcept>

#include "framework/interfaces/error.h"
#include "framework/shader/entry_tree.h"
#include "framework/shader/paged_buffers.h"
#include "framework/shader/uniform_blocks.h"

namespace dvrlab {
namespace {

/// The order of the texts. A part without a file is generated, is the kernel of a plugin, or the stream that fits it.
enum class From { framework, generated, entry, sampler, stream, estimator };
struct Part {
  From from;
  const char* file;
};
constexpr Part part_list[] = {
    {From::framework, "compat/glsl.glsl"},
    {From::generated, ""},
    {From::framework, "math.kernel"},
    {From::framework, "algebra.kernel"},
    {From::framework, "medium.kernel"},
    {From::framework, "ray.kernel"},
    {From::framework, "shading.kernel"},
    {From::framework, "segment.kernel"},
    {From::framework, "volume.kernel"},
    {From::entry, "tetrahedra.kernel"},
    {From::sampler, ""},
    {From::framework, "steps.kernel"},
    {From::framework, "parts.kernel"},
    {From::framework, "stream.glsl"},
    {From::stream, ""},
    {From::framework, "mean.kernel"},
    {From::framework, "discrete.kernel"},
    {From::framework, "light.kernel"},
    {From::estimator, ""},
    {From::framework, "integrate.kernel"},
    {From::framework, "composite.kernel"},
    {From::framework, "march.glsl"},
};

std::string read_text(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error("cannot read the kernel text " + file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Every name once: GLSL would say so too, but not who brought it.
class Names {
 public:
  void add(const std::string& name, const std::string& unit) {
    const auto [known, is_new] = owner_.emplace(name, unit);
    if (!is_new)
      throw std::logic_error("the name " + name + " is used by " + known->second + " and by " + unit +
                             "; names of uniforms and buffers begin with the plugin's name");
  }
  void add(const KernelUnit& unit, const std::string& role) {
    const std::string who = role + " \"" + unit.plugin + "\"";
    for (const Uniform& uniform : unit.uniforms) add(uniform.name, who);
    for (const Buffer& buffer : unit.buffers) add(buffer.name, who);
  }

 private:
  std::map<std::string, std::string> owner_;
};

void check_page_count(const ComposedShader& shader, const ShaderLimits& limits, std::uint64_t range) {
  std::size_t pages = 0;
  std::string list;
  for (const PagedBuffer& paged : shader.buffers) {
    pages += paged.pages.size();
    list += (list.empty() ? "" : ", ") + paged.buffer.name + " " + std::to_string(paged.buffer.bytes());
  }
  if (pages + 1 > std::size_t(limits.storage_buffers))
    throw NotSupported("the frame's buffers (bytes: " + list + ") need " + std::to_string(pages) +
                       " pages of at most " + std::to_string(range) + " bytes, but the device binds only " +
                       std::to_string(limits.storage_buffers - 1) +
                       " beside the output; use smaller data or the cpu backend");
}

}  // namespace

ComposedShader compose_shader(const FrameJob& job, const ShaderLimits& limits) {
  constexpr std::uint64_t smallest_limit = 64;  // bytes; a page holds whole words and the output's vectors
  if (job.gpu_buffer_limit != 0 && job.gpu_buffer_limit < smallest_limit)
    throw InputError("limits.gpu_buffer is " + std::to_string(job.gpu_buffer_limit) + " bytes; it must be at least " +
                     std::to_string(smallest_limit));
  const std::uint64_t range =
      job.gpu_buffer_limit == 0 ? limits.buffer_range : std::min(limits.buffer_range, job.gpu_buffer_limit);
  ComposedShader shader;
  shader.target = limits.target;
  shader.fast = job.precision == Precision::fast;
  if (!shader.fast) shader.float_modes = limits.float_modes;
  shader.band.name = "dvr_band";

  const std::vector<Uniform> band{Uniform::integer("frame_band_y", 0), Uniform::integer("frame_width", job.width),
                                  Uniform::integer("frame_height", job.height)};
  Names names;
  for (const Uniform& uniform : band) names.add(uniform.name, "the backend");
  const std::pair<const char*, const KernelUnit*> units[] = {
      {"frame", &job.frame}, {"sampler", &job.sampler}, {"estimator", &job.estimator}};
  int binding = ComposedShader::output_binding + 1;
  std::string buffers;
  for (const auto& [role, unit] : units) {
    names.add(*unit, role);
    const auto bind = [&](const Buffer& buffer) {
      shader.buffers.push_back(page_buffer(buffer, range, binding));
      binding += int(shader.buffers.back().pages.size());
      buffers += buffer_text(shader.buffers.back());
    };
    for (const Buffer& buffer : unit->buffers) bind(buffer);
    for (const EntrySurface& surface : unit->surfaces)
      for (const Buffer& buffer : *entry_tree_of(surface)) bind(buffer);
  }
  check_page_count(shader, limits, range);

  if (limits.target == ShaderTarget::opengl) binding = 0;
  shader.band = layout_block("dvr_band", band, limits.uniform_range);
  shader.band.binding = binding++;
  std::string generated =
      "layout(std430, binding = 0) writeonly buffer dvr_output { vec4 dvr_out[]; };\n" + block_text(shader.band, band);
  for (const auto& [role, unit] : units) {
    UniformBlock block = layout_block(std::string("dvr_") + role, unit->uniforms, limits.uniform_range);
    block.binding = binding;
    generated += block_text(block, unit->uniforms);
    if (block.members.empty()) continue;
    shader.blocks.push_back(std::move(block));
    ++binding;
  }
  generated += buffers;

  shader.sources.push_back("preamble");
  shader.text = std::string("#version 450\n#define DVR_RGB ") + (job.rgb ? "1" : "0") + "\n#define DVR_FULL " +
                (job.full ? "1" : "0") + "\n#define DVR_EAGER_GRADIENTS " + (limits.runs_both_branches ? "1" : "0") +
                "\n";
  for (const Part& part : part_list) {
    std::string name, text;
    switch (part.from) {
      case From::framework:
        name = part.file, text = read_text(job.kernel_folder + "/" + name);
        break;
      case From::stream:
        name = walks(job.sampler) ? "walk.glsl" : "steps.glsl", text = read_text(job.kernel_folder + "/" + name);
        break;
      case From::generated:
        name = "generated declarations", text = generated;
        break;
      case From::entry: {
        // A walk through tetrahedra, for samplers that have some.
        if (job.sampler.surfaces.empty()) continue;
        const std::string line = "#line 1 " + std::to_string(shader.sources.size()) + "\n";
        name = part.file, text = read_text(job.kernel_folder + "/entry.kernel");
        for (const EntrySurface& surface : job.sampler.surfaces) text += entry_declaration(surface);
        text += line + read_text(job.kernel_folder + "/" + name);
        for (const EntrySurface& surface : job.sampler.surfaces) text += entry_definition(surface);
        break;
      }
      case From::sampler:
        name = job.sampler.folder + "/" + job.sampler.plugin + ".kernel", text = read_text(name);
        break;
      case From::estimator:
        name = job.estimator.folder + "/" + job.estimator.plugin + ".kernel", text = read_text(name);
        break;
    }
    shader.text += "#line 1 " + std::to_string(shader.sources.size()) + "\n" + text + "\n";
    shader.sources.push_back(name);
  }
  return shader;
}

}  // namespace dvrlab
