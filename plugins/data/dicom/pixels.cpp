#include "plugins/data/dicom/pixels.h"

#include <gdcmImageReader.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <map>
#include <new>
#include <sstream>

#include "framework/interfaces/error.h"
#include "framework/scene/child.h"
#include "framework/scene/voxels.h"

namespace dvrlab::dicom {
namespace {

void check_size(const ImageHeader& h, std::uint64_t found, std::uint64_t wanted) {
  if (found == wanted) return;
  throw InputError(h.file + ": its pixels are " + std::to_string(found) + " bytes, its header announces " +
                   std::to_string(wanted) + "; it is cut off or its header is wrong");
}

// All frames of a file.
std::vector<char> decode(const ImageHeader& h) {
  const std::uint64_t wanted = h.format.plane_bytes() * h.slice.size();
  const bool plain = h.format.compression.empty();
  reading(h.file);
  try {
    gdcm::ImageReader reader;
    reader.SetFileName(h.file.c_str());
    if (reader.Read()) {
      const gdcm::Image& image = reader.GetImage();
      check_size(h, image.GetBufferLength(), wanted);
      // The library fills what is missing with whatever lies in memory; an odd length has a byte of padding.
      const gdcm::ByteValue* stored = image.GetDataElement().GetByteValue();
      if (plain && stored) check_size(h, std::min<std::uint64_t>(stored->GetLength(), wanted), wanted);
      std::vector<char> bytes(wanted);
      if (image.GetBuffer(bytes.data())) return bytes;
    }
  } catch (const InputError&) {
    throw;
  } catch (const std::exception&) {  // of the library; the reason is not for readers of configs
  }
  throw InputError(h.file + ": GDCM cannot decode its pixels" +
                   (plain ? "" : ", transfer syntax " + h.format.compression) + "; they are cut off or damaged");
}

// The pixel's BitsStored lowest bits, with their sign. Bits above them may hold overlays.
template <class T>
T value_of(T pixel, int stored) {
  const int unused = static_cast<int>(8 * sizeof(T)) - stored;
  using Unsigned = std::make_unsigned_t<T>;
  const auto up = static_cast<Unsigned>(static_cast<Unsigned>(pixel) << unused);
  return static_cast<T>(static_cast<T>(up) >> unused);  // arithmetic for signed T
}

struct Outcome {
  std::uint64_t cleared = 0;  // pixels with bits above BitsStored
  double rounding = 0;        // largest, when the values become float32
};

template <class T>
void place_slice(const char* in, std::uint64_t count, int stored, const Slice& s, T* kept, float* scaled,
                 Outcome& outcome) {
  for (std::uint64_t i = 0; i < count; ++i) {
    T pixel;
    std::memcpy(&pixel, in + i * sizeof(T), sizeof(T));
    const T value = value_of(pixel, stored);
    outcome.cleared += value != pixel ? 1u : 0u;
    if (!scaled) {
      kept[i] = value;
      continue;
    }
    const double physical = s.slope * static_cast<double>(value) + s.intercept;
    scaled[i] = static_cast<float>(physical);
    if (!std::isfinite(scaled[i]))
      throw InputError(s.file + ": RescaleSlope and RescaleIntercept give values beyond what float32 holds");
    outcome.rounding = std::max(outcome.rounding, std::fabs(physical - static_cast<double>(scaled[i])));
  }
}

template <class T>
Outcome place_all(void* volume, bool scaled, const Stack& stack, const std::vector<ImageHeader>& images) {
  std::map<std::string, std::vector<std::size_t>> places;  // of each file's slices in the volume
  for (std::size_t k = 0; k < stack.slice.size(); ++k) places[stack.slice[k].file].push_back(k);
  const std::uint64_t plane = stack.format.plane_bytes(), count = plane / sizeof(T);
  Outcome outcome;
  for (const ImageHeader& h : images) {
    const std::vector<char> pixels = decode(h);
    for (const std::size_t k : places[h.file]) {
      const Slice& s = stack.slice[k];
      place_slice<T>(pixels.data() + plane * static_cast<std::uint64_t>(s.frame), count, h.format.stored, s,
                     scaled ? nullptr : static_cast<T*>(volume) + k * count,
                     scaled ? static_cast<float*>(volume) + k * count : nullptr, outcome);
    }
  }
  return outcome;
}

// A file, its frames as the codec holds them (JPEG 2000: two 32-bit numbers per pixel) and decoded.
std::uint64_t largest_file(const std::vector<ImageHeader>& images) {
  std::uint64_t largest = 0;
  for (const ImageHeader& h : images)
    largest = std::max(
        largest, 2 * h.file_bytes + (h.format.compression.empty() ? 2 : 12) * h.format.plane_bytes() * h.slice.size());
  return largest;
}

// The same with the library's own buffers, and what malloc holds back.
std::uint64_t memory_for(const std::vector<ImageHeader>& images) { return 2 * largest_file(images) + (256 << 20); }

VoxelType type_of(const Stack& stack) {
  if (!stack.one_scaling()) return VoxelType::f32;
  if (stack.format.allocated == 8) return stack.format.is_signed ? VoxelType::i8 : VoxelType::u8;
  return stack.format.is_signed ? VoxelType::i16 : VoxelType::u16;
}

}  // namespace

void set_pixels(GridField& grid, const Stack& stack, const std::vector<ImageHeader>& images) {
  const bool scaled = !stack.one_scaling();
  grid.type = type_of(stack);
  const auto volume = shared_memory(grid.bytes(), grid.source);
  const auto shared_outcome = shared_memory(sizeof(Outcome), grid.source);
  Outcome& outcome = *new (shared_outcome.get()) Outcome{};
  const bool wide = stack.format.allocated == 16, is_signed = stack.format.is_signed;
  in_child("GDCM", memory_for(images), [&] {
    const auto place = [&]<class T>(T) { outcome = place_all<T>(volume.get(), scaled, stack, images); };
    if (wide)
      is_signed ? place(std::int16_t{}) : place(std::uint16_t{});
    else
      is_signed ? place(std::int8_t{}) : place(std::uint8_t{});
    return Bytes{};
  });
  grid.voxels = volume;
  grid.slope = scaled ? 1 : stack.slice.front().slope;
  grid.intercept = scaled ? 0 : stack.slice.front().intercept;
  if (scaled) {
    std::ostringstream note;
    note << "RescaleSlope or RescaleIntercept differ between slices: values are physical ones in float32, largest "
            "rounding error "
         << outcome.rounding;
    grid.notes.push_back(note.str());
  }
  if (outcome.cleared > 0)
    grid.notes.push_back(std::to_string(outcome.cleared) + " pixels had bits above BitsStored, which were cleared");
}

std::uint64_t set_pixels_bytes(const Stack& stack, const std::vector<ImageHeader>& images) {
  const std::uint64_t voxels = stack.slice.size() * static_cast<std::uint64_t>(stack.format.columns) *
                               static_cast<std::uint64_t>(stack.format.rows);
  return voxels * bytes_of(type_of(stack)) + largest_file(images);
}

}  // namespace dvrlab::dicom
