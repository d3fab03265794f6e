// Images on disk: float EXR, which keeps every bit, and 8-bit PNG, for looking at.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "framework/interfaces/backend.h"

namespace dvrlab {

/// EXR, float32, scan lines, ZIP. Channels: R G B = radiance including T * background; AR AG AB = 1 - T per channel and
/// A their mean, for other programs; TR TG TB = T itself, because 1 - T in float loses the low bits of a small T.
/// `attributes`: an object of strings and numbers, written to the header (numbers as double). The file appears
/// complete or not at all. Throws std::runtime_error naming the file.
void write_exr(const std::string& file, const FrameImage& image, const nlohmann::json& attributes);

/// Reads R G B and the transmittance: TR TG TB, else 1 - (AR AG AB), else 1 - A, else 0 (an opaque image).
/// R, G and B of a file written by write_exr have their bits, T too. Throws InputError naming the file.
FrameImage read_exr(const std::string& file);

/// PNG, 8-bit RGB: radiance clamped to [0,1] (NaN becomes 0), rounded to nearest, no further curve; `linear`: the
/// values are linear and are encoded as sRGB first. The file appears complete or not at all.
/// Throws std::runtime_error naming the file.
void write_png(const std::string& file, const FrameImage& image, bool linear);

}  // namespace dvrlab
