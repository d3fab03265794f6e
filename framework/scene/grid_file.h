// A volume in a file, or spread over files: what the header said, and how it becomes a grid. Readers of grid formats
// fill a GridFile from their header; everything behind it is shared.
#pragma once

#include <memory>
#include <span>
#include <string>
#include <vector>

#include "framework/interfaces/field.h"
#include "framework/scene/mapped_file.h"
#include "framework/scene/voxels.h"

namespace dvrlab {

/// How a file holds its voxels.
enum class Encoding { raw, gzip, bzip2, ascii, hex };  // gzip: zlib streams too

/// Encoded voxels, and the file that they lie in.
struct FilePart {
  std::shared_ptr<const MappedFile> file;
  std::span<const std::byte> bytes;
};

struct GridFile {
  std::string name;  // for messages, and the grid's source
  SourceType type = SourceType::u8;
  bool swap = false;  // the other byte order
  std::array<long long, 3> dims{};
  Affine to_world;  // voxel index -> world
  bool anatomical = false;
  std::string length_unit;
  double slope = 1, intercept = 0;
  std::vector<std::string> notes;

  std::shared_ptr<const MappedFile> header;
  Encoding encoding = Encoding::raw;
  std::uint64_t skip = 0;       // decoded bytes in front of the voxels of each part
  std::vector<FilePart> parts;  // of equal size, in the order of the voxels
};

/// The grid, with the SHA-256 of the header's file and the parts' files, one after the other. Raw voxels in the
/// machine's byte order stay in the mapped file; what has to be decoded is allocated only when the encoded bytes can
/// hold it. The hash is computed beside the decoding, on a thread of its own.
/// Throws InputError when the file is damaged, cut off, not finite (see finish_grid), or announces what it cannot hold.
std::shared_ptr<const Field> load_grid_file(GridFile file, const LoadContext& context);

/// Bytes that load_grid_file allocates at the most.
std::uint64_t grid_file_bytes(const GridFile& file);

/// A reader whose whole work is a file's header.
class GridFilePlugin : public DataPlugin {
 public:
  std::shared_ptr<const Field> load(const ParameterSet& p, const LoadContext& context) const final {
    return load_grid_file(open(p, context), context);
  }
  std::uint64_t bytes_needed(const ParameterSet& p, const LoadContext& context) const final {
    return grid_file_bytes(open(p, context));
  }

 protected:
  /// What the header says; throws InputError naming the file and what is wrong with it.
  virtual GridFile open(const ParameterSet& p, const LoadContext& context) const = 0;
};

/// The grid's bytes as the file holds them; throws like grid_bytes().
std::uint64_t stored_bytes(const GridFile& file);

/// The end of `bytes`, `wanted` long; all of them when there are fewer.
std::span<const std::byte> last_bytes(std::span<const std::byte> bytes, std::uint64_t wanted);

/// Multiplies the world's axes by 1 or -1, so that a named anatomical space becomes RAS.
void flip_world(Affine& to_world, const Vector3& sign);

}  // namespace dvrlab
