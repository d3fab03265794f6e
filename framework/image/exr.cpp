#include <ImfChannelList.h>
#include <ImfCompression.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>

#include <array>
#include <nlohmann/json.hpp>

#include "framework/image/atomic_file.h"
#include "framework/image/image_io.h"
#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

constexpr std::array<const char*, 3> color_names{"R", "G", "B"};
constexpr std::array<const char*, 3> alpha_names{"AR", "AG", "AB"};
constexpr std::array<const char*, 3> trans_names{"TR", "TG", "TB"};

// Channel c of pixels with `stride` floats each. `first` is the memory of the pixel (x0, y0).
Imf::Slice slice(float* first, int stride, int width, int x0 = 0, int y0 = 0) {
  const std::size_t x_stride = sizeof(float) * static_cast<std::size_t>(stride);
  return Imf::Slice::Make(Imf::FLOAT, first, Imath::V2i(x0, y0), width, 1 << 30, x_stride,
                          x_stride * static_cast<std::size_t>(width));
}

void write_file(const std::string& file, FrameImage image, const nlohmann::json& attributes) {
  const std::size_t pixels = static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height);
  std::vector<float> alpha(4 * pixels);  // AR AG AB A
  for (std::size_t p = 0; p < pixels; ++p) {
    for (std::size_t c = 0; c < 3; ++c) alpha[4 * p + c] = 1.0f - image.trans[3 * p + c];
    alpha[4 * p + 3] = (alpha[4 * p] + alpha[4 * p + 1] + alpha[4 * p + 2]) / 3.0f;
  }
  Imf::Header header(image.width, image.height);
  header.compression() = Imf::ZIP_COMPRESSION;
  for (const auto& [key, value] : attributes.items()) {
    if (value.is_number())
      header.insert(key, Imf::DoubleAttribute(value.get<double>()));
    else
      header.insert(key, Imf::StringAttribute(value.get<std::string>()));
  }
  Imf::FrameBuffer buffer;
  const auto add = [&](const char* name, float* first, int stride) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(name, slice(first, stride, image.width));
  };
  for (std::size_t c = 0; c < 3; ++c) {
    add(color_names[c], image.color.data() + c, 3);
    add(alpha_names[c], alpha.data() + c, 4);
    add(trans_names[c], image.trans.data() + c, 3);
  }
  add("A", alpha.data() + 3, 4);
  Imf::OutputFile out(file.c_str(), header);
  out.setFrameBuffer(buffer);
  out.writePixels(image.height);
}

FrameImage read_file(const std::string& file) {
  Imf::InputFile in(file.c_str());
  const Imath::Box2i window = in.header().dataWindow();
  const auto has = [&](const char* name) { return in.header().channels().findChannel(name) != nullptr; };
  for (const char* name : color_names)
    if (!has(name)) throw InputError(std::string("has no channel ") + name + "; an RGB image is needed");

  const long long width = 1ll + window.max.x - window.min.x, height = 1ll + window.max.y - window.min.y;
  if (width < 1 || height < 1 || width > (1ll << 20) || height > (1ll << 20) || width * height > (1ll << 30))
    throw InputError("has an implausible size of " + std::to_string(width) + " x " + std::to_string(height));
  FrameImage image;
  image.width = static_cast<int>(width);
  image.height = static_cast<int>(height);
  image.color.resize(3 * static_cast<std::size_t>(width * height));
  image.trans.resize(image.color.size());

  const bool t = has(trans_names[0]) && has(trans_names[1]) && has(trans_names[2]);
  const bool rgb_alpha = has(alpha_names[0]) && has(alpha_names[1]) && has(alpha_names[2]);
  Imf::FrameBuffer buffer;
  for (std::size_t c = 0; c < 3; ++c) {
    const auto place = [&](std::vector<float>& v) {
      return slice(v.data() + c, 3, image.width, window.min.x, window.min.y);
    };
    buffer.insert(color_names[c], place(image.color));
    if (t || rgb_alpha) buffer.insert((t ? trans_names : alpha_names)[c], place(image.trans));
  }
  if (!t && !rgb_alpha && has("A"))
    buffer.insert("A", slice(image.trans.data(), 3, image.width, window.min.x, window.min.y));
  in.setFrameBuffer(buffer);
  in.readPixels(window.min.y, window.max.y);

  if (t) return image;
  if (!rgb_alpha) {
    const bool alpha = has("A");
    for (std::size_t p = 0; p < image.trans.size(); p += 3) {
      const float a = alpha ? image.trans[p] : 1.0f;
      image.trans[p] = image.trans[p + 1] = image.trans[p + 2] = a;
    }
  }
  for (float& x : image.trans) x = 1.0f - x;
  return image;
}

}  // namespace

void write_exr(const std::string& file, const FrameImage& image, const nlohmann::json& attributes) {
  write_atomically(file, [&](const std::string& temporary) { write_file(temporary, image, attributes); });
}

FrameImage read_exr(const std::string& file) {
  try {
    return read_file(file);
  } catch (const std::exception& e) {
    throw InputError(file + ": cannot be read as an EXR image: " + e.what());
  }
}

}  // namespace dvrlab
