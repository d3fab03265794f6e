#include "backends/opengl/device.h"

#include <stdexcept>

#include "backends/opengl/limits.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

class GlBuffer final : public GpuBuffer {
 public:
  GlBuffer(const EglContext& context, GLenum target, std::uint64_t bytes, std::uint64_t& allocated)
      : GpuBuffer(bytes), context_(context), allocated_(allocated), target_(target) {
    context.gl().CreateBuffers(1, &name_);
    context.gl().NamedBufferStorage(name_, GLsizeiptr(bytes), nullptr, GL_DYNAMIC_STORAGE_BIT);
    allocated_ += bytes;
  }
  ~GlBuffer() override {
    context_.make_current();
    context_.gl().DeleteBuffers(1, &name_);
    allocated_ -= bytes();
  }
  GLuint name() const { return name_; }
  GLenum target() const { return target_; }

 private:
  const EglContext& context_;
  std::uint64_t& allocated_;
  GLenum target_;
  GLuint name_ = 0;
};

const GlBuffer& as_gl(const GpuBuffer& buffer) { return static_cast<const GlBuffer&>(buffer); }

void APIENTRY collect(GLenum, GLenum type, GLuint, GLenum severity, GLsizei, const GLchar* text, const void* messages) {
  const bool fault = type == GL_DEBUG_TYPE_ERROR || type == GL_DEBUG_TYPE_UNDEFINED_BEHAVIOR;
  if (!fault && severity != GL_DEBUG_SEVERITY_HIGH) return;
  // KHR_debug hands the pointer back as it was given, but const.
  const_cast<std::vector<std::string>*>(static_cast<const std::vector<std::string>*>(messages))->push_back(text);
}

}  // namespace

GlDevice::GlDevice(const std::string& device, bool debug)
    : context_(EglContext::open(device, debug)), gl_(context_->gl()) {
  begin_frame();  // with a device named, a context beside the chosen one was the last to be current
  if (debug) {
    gl_.Enable(GL_DEBUG_OUTPUT);
    gl_.Enable(GL_DEBUG_OUTPUT_SYNCHRONOUS);
    gl_.DebugMessageCallback(collect, &messages_);
  }
  limits_ = shader_limits(gl_);
  GLint bits = 0;
  gl_.GetQueryiv(GL_TIMESTAMP, GL_QUERY_COUNTER_BITS, &bits);
  has_clock_ = bits > 0;
  gl_.CreateQueries(GL_TIMESTAMP, 2, queries_);
  check("starting");
}

GlDevice::~GlDevice() {
  context_->make_current();
  programs_.clear();
  gl_.DeleteQueries(2, queries_);
}

DeviceInfo GlDevice::info() const {
  context_->make_current();
  DeviceInfo info;
  info.device = gl_.text(GL_RENDERER);
  info.driver = gl_.text(GL_VENDOR) + " " + gl_.text(GL_VERSION);
  info.api = "OpenGL 4.5 core, GL_ARB_gl_spirv";
  info.detail = "storage buffers of " + std::to_string(limits_.buffer_range) + " bytes, " +
                std::to_string(limits_.storage_buffers) + " at once; march timed by " +
                (has_clock_ ? "device timestamps" : "the wall clock");
  return info;
}

void GlDevice::begin_frame() { context_->make_current(); }

void GlDevice::end_frame() {
  check("rendering");
  const std::vector<std::string> messages = std::move(messages_);
  messages_.clear();
  if (messages.empty()) return;
  std::string text = "OpenGL debug output says:";
  for (const std::string& message : messages) text += "\n" + message;
  throw std::runtime_error(text);
}

void GlDevice::check(const char* what) {
  const GLenum error = gl_.GetError();
  if (error == GL_NO_ERROR) return;
  const std::string where = gl_.text(GL_RENDERER) + ", " + what + ": ";
  const std::string bytes = " (" + std::to_string(allocated_) + " bytes of buffers in use)";
  if (error == GL_OUT_OF_MEMORY) throw NotSupported(where + "out of memory" + bytes);
  throw std::runtime_error(where + "OpenGL error " + std::to_string(error) + bytes);
}

std::unique_ptr<GpuBuffer> GlDevice::make_buffer(BufferUse use, std::uint64_t bytes) {
  const GLenum target = use == BufferUse::uniform ? GL_UNIFORM_BUFFER : GL_SHADER_STORAGE_BUFFER;
  auto buffer = std::make_unique<GlBuffer>(*context_, target, bytes, allocated_);
  check(("allocating " + std::to_string(bytes) + " bytes").c_str());
  return buffer;
}

void GlDevice::write(GpuBuffer& buffer, const void* data, std::uint64_t bytes) {
  const GLuint name = as_gl(buffer).name();
  if (bytes != 0) gl_.NamedBufferSubData(name, 0, GLsizeiptr(bytes), data);
  if (const std::uint64_t rest = buffer.bytes() - bytes; rest != 0) {
    const std::vector<std::byte> zeros(rest);
    gl_.NamedBufferSubData(name, GLintptr(bytes), GLsizeiptr(rest), zeros.data());
  }
  check("uploading");
}

void GlDevice::read(GpuBuffer& buffer, void* data, std::uint64_t bytes) {
  gl_.GetNamedBufferSubData(as_gl(buffer).name(), 0, GLsizeiptr(bytes), data);
  check("downloading");
}

GlProgram::GlProgram(const GlFunctions& gl, const Spirv& spirv) : gl_(gl), name_(gl.CreateProgram()) {
  const auto failed = [&](const char* log) {
    gl_.DeleteProgram(name_);
    throw std::runtime_error(gl_.text(GL_RENDERER) + " refuses the shader: " + log);
  };
  const GLuint shader = gl_.CreateShader(GL_COMPUTE_SHADER);
  gl_.ShaderBinary(1, &shader, GL_SHADER_BINARY_FORMAT_SPIR_V_ARB, spirv.data(),
                   GLsizei(spirv.size() * sizeof(std::uint32_t)));
  gl_.SpecializeShaderARB(shader, "main", 0, nullptr, nullptr);
  GLint good = 0;
  char log[4096] = "";
  gl_.GetShaderiv(shader, GL_COMPILE_STATUS, &good);
  if (!good) gl_.GetShaderInfoLog(shader, sizeof(log), nullptr, log);
  gl_.AttachShader(name_, shader);
  gl_.DeleteShader(shader);  // goes with the program
  if (!good) failed(log);
  gl_.LinkProgram(name_);
  gl_.GetProgramiv(name_, GL_LINK_STATUS, &good);
  if (!good) gl_.GetProgramInfoLog(name_, sizeof(log), nullptr, log);
  if (!good) failed(log);
}

GlProgram::~GlProgram() { gl_.DeleteProgram(name_); }

void GlDevice::set_program(const Spirv& spirv, const std::vector<GpuBinding>&) {
  program_ = programs_.use(spirv, [&] { return std::make_unique<GlProgram>(gl_, spirv); })->name();
  check("compiling the shader");
}

void GlDevice::bind(int binding, GpuBuffer& buffer) {
  gl_.BindBufferBase(as_gl(buffer).target(), GLuint(binding), as_gl(buffer).name());
}

double GlDevice::dispatch(unsigned groups_x, unsigned groups_y) {
  gl_.UseProgram(program_);
  gl_.QueryCounter(queries_[0], GL_TIMESTAMP);
  gl_.DispatchCompute(groups_x, groups_y, 1);
  gl_.MemoryBarrier(GL_BUFFER_UPDATE_BARRIER_BIT);
  gl_.QueryCounter(queries_[1], GL_TIMESTAMP);
  gl_.Finish();
  check("marching");
  if (!has_clock_) return -1.0;
  GLuint64 time[2] = {};
  for (int q = 0; q < 2; ++q) gl_.GetQueryObjectui64v(queries_[q], GL_QUERY_RESULT, &time[q]);
  return double(time[1] - time[0]) * 1e-9;
}

}  // namespace dvrlab
