#include "framework/shader/compose.h"

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <span>
#include <stdexcept>

#include "framework/interfaces/error.h"
#include "framework/shader/entry_tree.h"
#include "framework/shader/paged_buffers.h"
#include "framework/shader/uniform_blocks.h"

namespace dvrlab {
namespace {

/// The order of the texts. A part without a file is generated, is the kernel of a plugin, or the stream that fits it.
enum class From { framework, generated, entry, sampler, stream, estimator, stage };
struct Part {
  From from;
  const char* file;
};
constexpr Part frame_parts[] = {
    {From::framework, "compat/glsl.glsl"},
    {From::generated, ""},
    {From::framework, "math.kernel"},
    {From::framework, "algebra.kernel"},
    {From::framework, "medium.kernel"},
    {From::framework, "ray.kernel"},
    {From::framework, "volume.kernel"},
    {From::framework, "blocks.kernel"},
    {From::framework, "light_volume.kernel"},
    {From::framework, "shading.kernel"},
    {From::framework, "segment.kernel"},
    {From::entry, "tetrahedra.kernel"},
    {From::sampler, ""},
    {From::framework, "random.kernel"},
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
constexpr Part stage_parts[] = {
    {From::framework, "compat/glsl.glsl"},
    {From::generated, ""},
    {From::framework, "math.kernel"},
    {From::framework, "algebra.kernel"},
    {From::framework, "volume.kernel"},
    {From::framework, "blocks.kernel"},
    {From::sampler, ""},
    {From::framework, "random.kernel"},
    {From::framework, "light_ray.kernel"},
    {From::stage, ""},
    {From::framework, "stage.glsl"},
};

/// What the two kinds of shader share, and what tells them apart.
struct Composition {
  std::span<const Part> parts;
  std::vector<std::pair<const char*, const KernelUnit*>> units;  // by their roles
  const KernelUnit* sampler;
  const char* output;  // type of its elements
  int width, height;
  std::string features;  // #define lines
  std::string kernel_folder;
  std::uint64_t gpu_buffer_limit;
  bool fast;
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

ComposedShader compose(const Composition& job, const ShaderLimits& limits) {
  constexpr std::uint64_t smallest_limit = 64;  // bytes; a page holds whole words and the output's vectors
  if (job.gpu_buffer_limit != 0 && job.gpu_buffer_limit < smallest_limit)
    throw InputError("limits.gpu_buffer is " + std::to_string(job.gpu_buffer_limit) + " bytes; it must be at least " +
                     std::to_string(smallest_limit));
  const std::uint64_t range =
      job.gpu_buffer_limit == 0 ? limits.buffer_range : std::min(limits.buffer_range, job.gpu_buffer_limit);
  ComposedShader shader;
  shader.target = limits.target;
  shader.fast = job.fast;
  if (!shader.fast) shader.float_modes = limits.float_modes;
  shader.band.name = "dvr_band";

  const std::vector<Uniform> band{Uniform::integer("frame_band_y", 0), Uniform::integer("frame_width", job.width),
                                  Uniform::integer("frame_height", job.height)};
  Names names;
  for (const Uniform& uniform : band) names.add(uniform.name, "the backend");
  int binding = ComposedShader::output_binding + 1;
  std::string buffers;
  for (const auto& [role, unit] : job.units) {
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
  std::string generated = std::string("layout(std430, binding = 0) writeonly buffer dvr_output { ") + job.output +
                          " dvr_out[]; };\n" + block_text(shader.band, band);
  for (const auto& [role, unit] : job.units) {
    UniformBlock block = layout_block(std::string("dvr_") + role, unit->uniforms, limits.uniform_range);
    block.binding = binding;
    generated += block_text(block, unit->uniforms);
    if (block.members.empty()) continue;
    shader.blocks.push_back(std::move(block));
    ++binding;
  }
  generated += buffers;

  shader.sources.push_back("preamble");
  shader.text = "#version 450\n" + job.features;
  for (const Part& part : job.parts) {
    std::string name, text;
    switch (part.from) {
      case From::framework:
        name = part.file, text = read_text(job.kernel_folder + "/" + name);
        break;
      case From::stream:
        name = walks(*job.sampler) ? "walk.glsl" : "steps.glsl", text = read_text(job.kernel_folder + "/" + name);
        break;
      case From::generated:
        name = "generated declarations", text = generated;
        break;
      case From::entry: {
        // A walk through tetrahedra, for samplers that have some.
        if (job.sampler->surfaces.empty()) continue;
        const std::string line = "#line 1 " + std::to_string(shader.sources.size()) + "\n";
        name = part.file, text = read_text(job.kernel_folder + "/entry.kernel");
        for (const EntrySurface& surface : job.sampler->surfaces) text += entry_declaration(surface);
        text += line + read_text(job.kernel_folder + "/" + name);
        for (const EntrySurface& surface : job.sampler->surfaces) text += entry_definition(surface);
        break;
      }
      case From::sampler:
        name = job.sampler->folder + "/" + job.sampler->plugin + ".kernel", text = read_text(name);
        break;
      case From::estimator:
      case From::stage: {
        const KernelUnit& unit = *job.units.back().second;
        name = unit.folder + "/" + unit.plugin + ".kernel", text = read_text(name);
        break;
      }
    }
    shader.text += "#line 1 " + std::to_string(shader.sources.size()) + "\n" + text + "\n";
    shader.sources.push_back(name);
  }
  return shader;
}

std::string define(const char* name, bool on) { return std::string("#define ") + name + (on ? " 1\n" : " 0\n"); }

}  // namespace

ComposedShader compose_shader(const FrameJob& job, const ShaderLimits& limits) {
  return compose({frame_parts,
                  {{"frame", &job.frame}, {"sampler", &job.sampler}, {"estimator", &job.estimator}},
                  &job.sampler,
                  "vec4",
                  job.width,
                  job.height,
                  define("DVR_RGB", job.rgb) + define("DVR_FULL", job.full) +
                      define("DVR_EAGER_GRADIENTS", limits.runs_both_branches),
                  job.kernel_folder,
                  job.gpu_buffer_limit,
                  job.precision == Precision::fast},
                 limits);
}

ComposedShader compose_stage(const StageJob& job, const ShaderLimits& limits) {
  if (walks(job.sampler))
    throw NotSupported("sampler \"" + job.sampler.plugin +
                       "\" cannot be asked at positions, so that no light volume can be filled");
  return compose({stage_parts,
                  {{"rays", &job.rays}, {"sampler", &job.sampler}, {"stage", &job.stage}},
                  &job.sampler,
                  "float",
                  job.grid.dims[0],
                  job.grid.dims[1] * job.grid.dims[2],
                  define("DVR_RGB", job.rgb),
                  job.kernel_folder,
                  job.gpu_buffer_limit,
                  job.precision == Precision::fast},
                 limits);
}

}  // namespace dvrlab
