#include "framework/shader/gpu_session.h"

#include <algorithm>
#include <bit>
#include <cstring>

#include "framework/interfaces/error.h"
#include "framework/scene/phase_clock.h"
#include "framework/shader/compile.h"
#include "framework/shader/compose.h"

namespace dvrlab {
namespace {

constexpr std::uint64_t pixel_bytes = 2 * 4 * sizeof(float);
constexpr std::uint64_t page_padding = 32;  // at most, see page_buffer()

void add_phase(FrameResult& result, const char* phase, const PhaseClock& clock) {
  result.times.push_back({phase, clock.wall(), clock.cpu()});
}

/// Two vec4 per pixel, see ComposedShader.
void decode_rows(const std::vector<float>& rows, int first, int count, FrameResult& result) {
  FrameImage& image = result.image;
  const std::size_t pixels = std::size_t(count) * std::size_t(image.width);
  const std::size_t start = std::size_t(first) * std::size_t(image.width);
  for (std::size_t p = 0; p < pixels; ++p) {
    const float* value = rows.data() + 8 * p;
    std::copy_n(value, 3, image.color.begin() + std::ptrdiff_t(3 * (start + p)));
    std::copy_n(value + 4, 3, image.trans.begin() + std::ptrdiff_t(3 * (start + p)));
    const auto ends = std::bit_cast<std::uint32_t>(value[7]);
    const auto samples = std::bit_cast<std::uint32_t>(value[3]);
    if (samples == ComposedShader::cut_march) {
      const auto x = p % std::size_t(image.width), y = std::size_t(first) + p / std::size_t(image.width);
      throw NotSupported("the driver ended the march of pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                         ") before its ray was through, as software GPUs do after 65535 rounds of all loops together; "
                         "use a longer step or the cpu backend");
    }
    result.counters.samples += samples;
    result.counters.skipped += ends >> 1;
    result.counters.terminated += ends & 1;
  }
}

}  // namespace

GpuSession::GpuSession(std::unique_ptr<GpuDevice> device, double band_seconds)
    : device_(std::move(device)), band_seconds_(band_seconds), plan_(band_seconds) {}

int GpuSession::output_rows(int width, int height) const {
  constexpr int group = ComposedShader::workgroup;
  const std::uint64_t largest = device_->limits().buffer_range / (std::uint64_t(width) * pixel_bytes);
  if (largest < group)
    throw NotSupported("an image " + std::to_string(width) +
                       " pixels wide does not fit the device's storage buffers of " +
                       std::to_string(device_->limits().buffer_range) + " bytes");
  const std::uint64_t rows = std::min<std::uint64_t>(largest, std::uint64_t(height) + group - 1);
  return int(rows / group * group);
}

std::uint64_t GpuSession::bytes_needed(const FrameJob& job) const {
  const std::uint64_t output =
      std::uint64_t(output_rows(job.width, job.height)) * std::uint64_t(job.width) * pixel_bytes;
  const std::uint64_t image = std::uint64_t(job.width) * std::uint64_t(job.height) * 6 * sizeof(float);
  std::uint64_t buffers = 0, largest = 0;
  for (const KernelUnit* unit : {&job.frame, &job.sampler, &job.estimator})
    for (const Buffer& buffer : unit->buffers) {
      buffers += buffer.bytes() + page_padding;
      largest = std::max(largest, buffer.bytes());
    }
  // The output exists on the device and as rows on the host; a device with its own memory is fed by way of a copy.
  return image + 2 * output + (device_->shares_memory() ? buffers : std::min(largest, buffers));
}

bool GpuSession::same(const Resident& resident, const PagedBuffer& wanted) {
  const std::shared_ptr<const void> source = resident.source.lock();
  return source != nullptr && source == wanted.buffer.data && resident.count == wanted.buffer.count &&
         resident.element == wanted.buffer.element && resident.page_elements == wanted.page_elements;
}

bool GpuSession::compile(const ComposedShader& shader) {
  std::string hash = shader_hash(shader);
  if (hash == program_) return false;
  program_.clear();
  std::vector<GpuBinding> bindings{{ComposedShader::output_binding, BufferUse::output},
                                   {shader.band.binding, BufferUse::uniform}};
  for (const UniformBlock& block : shader.blocks) bindings.push_back({block.binding, BufferUse::uniform});
  for (const PagedBuffer& paged : shader.buffers)
    for (const BufferPage& page : paged.pages) bindings.push_back({page.binding, BufferUse::storage});
  device_->set_program(compile_shader(shader).spirv, bindings);
  program_ = std::move(hash);
  return true;
}

void GpuSession::upload(const ComposedShader& shader) {
  std::uint64_t bytes = 0;
  std::map<std::string, Resident> kept;
  for (const PagedBuffer& paged : shader.buffers) {
    for (const BufferPage& page : paged.pages) bytes += page.allocated;
    const auto known = resident_.find(paged.buffer.name);
    if (known != resident_.end() && same(known->second, paged)) kept.insert(resident_.extract(known));
  }
  if (device_->memory() != 0 && bytes > device_->memory())
    throw NotSupported("the frame's buffers take " + std::to_string(bytes) + " bytes, but the device has " +
                       std::to_string(device_->memory()));
  resident_ = std::move(kept);  // frees what is not needed any more before more is taken
  for (const PagedBuffer& paged : shader.buffers) {
    if (resident_.contains(paged.buffer.name)) continue;
    Resident fresh{paged.buffer.data, paged.buffer.element, paged.buffer.count, paged.page_elements, {}};
    for (const BufferPage& page : paged.pages) {
      fresh.pages.push_back(device_->make_buffer(BufferUse::storage, page.allocated));
      device_->write(*fresh.pages.back(), static_cast<const std::byte*>(paged.buffer.data.get()) + page.offset,
                     page.bytes);
    }
    resident_.emplace(paged.buffer.name, std::move(fresh));
  }
}

void GpuSession::bind(const ComposedShader& shader) {
  uniforms_.resize(1 + shader.blocks.size());
  for (std::size_t i = 0; i < uniforms_.size(); ++i) {
    const UniformBlock& block = i == 0 ? shader.band : shader.blocks[i - 1];
    if (!uniforms_[i] || uniforms_[i]->bytes() != block.bytes.size())
      uniforms_[i] = device_->make_buffer(BufferUse::uniform, block.bytes.size());
    device_->write(*uniforms_[i], block.bytes.data(), block.bytes.size());
    device_->bind(block.binding, *uniforms_[i]);
  }
  for (const PagedBuffer& paged : shader.buffers)
    for (std::size_t p = 0; p < paged.pages.size(); ++p)
      device_->bind(paged.pages[p].binding, *resident_.at(paged.buffer.name).pages[p]);
  device_->bind(ComposedShader::output_binding, *output_);
}

void GpuSession::write_band(const ComposedShader& shader, int row, int width, int height) {
  std::vector<std::byte> bytes = shader.band.bytes;
  const int values[] = {row, width, height};
  for (std::size_t i = 0; i < shader.band.members.size(); ++i)
    std::memcpy(bytes.data() + shader.band.members[i].offset, &values[i], sizeof(int));
  device_->write(*uniforms_[0], bytes.data(), bytes.size());
}

void GpuSession::march_bands(const FrameJob& job, const ComposedShader& shader, FrameResult& result) {
  constexpr int group = ComposedShader::workgroup;
  PhaseTime march{"march", 0, 0}, download{"download", 0, 0};
  std::vector<float> rows;
  const int largest = output_rows(job.width, job.height);
  for (int y = 0; y < job.height;) {
    const int count = plan_.rows(job.height - y, largest);
    write_band(shader, y, job.width, job.height);
    const PhaseClock busy;
    double seconds = device_->dispatch(unsigned(job.width + group - 1) / group, unsigned(count) / group);
    if (seconds < 0) seconds = busy.wall();
    march.seconds += seconds;
    march.cpu_seconds += busy.cpu();
    plan_.measured(count, seconds);
    const PhaseClock copying;
    const int real = std::min(count, job.height - y);
    rows.resize(std::size_t(real) * std::size_t(job.width) * 8);
    device_->read(*output_, rows.data(), rows.size() * sizeof(float));
    decode_rows(rows, y, real, result);
    download.seconds += copying.wall();
    download.cpu_seconds += copying.cpu();
    y += count;
  }
  result.times.push_back(march);
  result.times.push_back(download);
}

void GpuSession::march(const FrameJob& job, FrameResult& result) {
  result = FrameResult{};
  const std::size_t values = std::size_t(job.width) * std::size_t(job.height) * 3;
  result.image = {job.width, job.height, std::vector<float>(values), std::vector<float>(values)};
  device_->begin_frame();
  const PhaseClock compiling;
  const ComposedShader shader = compose_shader(job, device_->limits());
  const bool is_new = compile(shader);
  const double compile_wall = compiling.wall(), compile_cpu = compiling.cpu();

  const PhaseClock uploading;
  const std::uint64_t output =
      std::uint64_t(output_rows(job.width, job.height)) * std::uint64_t(job.width) * pixel_bytes;
  if (!output_ || output_->bytes() != output) {
    output_.reset();
    output_ = device_->make_buffer(BufferUse::output, output);
  }
  upload(shader);
  bind(shader);
  add_phase(result, "upload", uploading);

  // A driver may finish its compilation at the first dispatch: one group outside the image, counted as compiling.
  const PhaseClock warming;
  if (is_new) {
    write_band(shader, 0, job.width, 0);
    device_->dispatch(1, 1);
  }
  result.times.push_back({"compile", compile_wall + warming.wall(), compile_cpu + warming.cpu()});
  march_bands(job, shader, result);
  device_->end_frame();
}

void GpuSession::fill(const StageJob& job, LightVolume& volume) {
  const auto width = std::size_t(job.grid.dims[0]), channels = std::size_t(job.grid.channels);
  const int height = job.grid.dims[1] * job.grid.dims[2];
  const std::uint64_t row_bytes = width * channels * sizeof(float);
  constexpr int group = ComposedShader::workgroup;
  constexpr std::uint64_t most_groups = 65535;  // in y: what every device dispatches
  const ShaderLimits limits = device_->limits();
  const auto largest =
      int(std::min({limits.buffer_range / row_bytes, most_groups * group, std::uint64_t(height) + group - 1})) / group *
      group;
  if (largest < group)
    throw NotSupported("a light volume " + std::to_string(width) +
                       " points wide does not fit the device's storage buffers of " +
                       std::to_string(limits.buffer_range) + " bytes");
  if (job.long_loops && limits.runs_both_branches)
    throw NotSupported("stage " + job.stage.plugin +
                       " may take more rounds per voxel than software GPUs make (65535); use backend cpu");
  device_->begin_frame();
  const ComposedShader shader = compose_stage(job, limits);
  compile(shader);
  output_.reset();
  output_ = device_->make_buffer(BufferUse::output, std::uint64_t(largest) * row_bytes);
  upload(shader);
  bind(shader);
  BandPlan plan(band_seconds_);
  std::vector<float> rows;
  for (int row = 0; row < height;) {
    const int count = plan.rows(height - row, largest);
    write_band(shader, row, int(width), height);
    const PhaseClock busy;
    const double seconds = device_->dispatch(unsigned(width + group - 1) / group, unsigned(count) / group);
    plan.measured(count, seconds < 0 ? busy.wall() : seconds);
    const int real = std::min(count, height - row);
    rows.resize(std::size_t(real) * width * channels);
    device_->read(*output_, rows.data(), rows.size() * sizeof(float));
    for (std::size_t r = 0; r < std::size_t(real); ++r)
      for (std::size_t c = 0; c < channels; ++c)
        std::copy_n(rows.begin() + std::ptrdiff_t((r * channels + c) * width), width,
                    volume.values->begin() + std::ptrdiff_t(c * job.grid.points() + (std::size_t(row) + r) * width));
    row += count;
  }
  device_->end_frame();
}

}  // namespace dvrlab
