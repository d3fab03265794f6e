#include "framework/scene/grid_file.h"

#include <algorithm>
#include <cstring>
#include <future>

#include "framework/interfaces/error.h"
#include "framework/scene/bzip2.h"
#include "framework/scene/gzip.h"
#include "framework/scene/sha256.h"
#include "framework/scene/text_voxels.h"

namespace dvrlab {
namespace {

using BytesIn = std::span<const std::byte>;
using BytesOut = std::span<std::byte>;

// Decoded in front of the voxels when it is short, as the 352 bytes of a NIfTI header are; else dropped piece by piece.
constexpr std::uint64_t longest_lead = 1 << 16;

// Padding behind compressed voxels is read up to here, so that the checksum behind it is checked too.
constexpr std::uint64_t longest_tail = 1 << 16;

struct Found {
  std::uint64_t bytes;
  bool more;
};

// The most that `encoded` bytes can hold, from the encoding's definition.
std::uint64_t most_bytes(const GridFile& f, std::uint64_t encoded) {
  switch (f.encoding) {
    case Encoding::raw:
      return encoded;
    case Encoding::gzip:
      return gunzip_limit(encoded);
    case Encoding::bzip2:
      return bunzip2_limit(encoded);
    case Encoding::ascii:  // a digit and a blank per number
      return (encoded + 1) / 2 * bytes_of(f.type);
    case Encoding::hex:
      return encoded / 2;
  }
  return 0;
}

[[noreturn]] void truncated(const GridFile& f, std::size_t part, std::uint64_t wanted, const std::string& found) {
  const std::string which =
      f.parts.size() > 1 ? " per data file, data file " + std::to_string(part + 1) + " holds " : ", the data holds ";
  throw InputError(f.name + ": the header announces " + std::to_string(wanted) + " bytes of voxels" + which + found +
                   "; the file is cut off or its header is wrong");
}

Found unpack(const GridFile& f, Unpacker& u, BytesOut out) {
  if (u.skip(f.skip) < f.skip) return {0, false};
  const std::size_t bytes = u.fill(out);
  if (bytes < out.size()) return {bytes, false};
  const std::uint64_t tail = u.skip(longest_tail);
  if (u.more())
    throw InputError(f.name + ": the compressed data goes on beyond the " + std::to_string(out.size()) +
                     " bytes of voxels that the header announces; the header is wrong, or the file is made to swell");
  return {bytes, tail > 0};
}

// `lead` bytes of what f.skip drops stand in front of `out` as room.
Found decode(const GridFile& f, BytesIn in, BytesOut out, std::size_t lead) {
  switch (f.encoding) {
    case Encoding::raw:
      std::copy_n(in.begin() + static_cast<std::ptrdiff_t>(f.skip), out.size(), out.begin());
      return {out.size(), in.size() - f.skip > out.size()};
    case Encoding::gzip:
      if (lead == f.skip && gunzip_exactly(in, {out.data() - lead, lead + out.size()})) return {out.size(), false};
      return unpack(f, *gzip_unpacker(in, f.name), out);
    case Encoding::bzip2:
      return unpack(f, *bzip2_unpacker(in, f.name), out);
    case Encoding::ascii: {
      const TextVoxels t = read_ascii(in, f.type, out, f.name);
      return {t.bytes, t.more};
    }
    case Encoding::hex: {
      const TextVoxels t = read_hex(in, out, f.name);
      return {t.bytes, t.more};
    }
  }
  return {0, false};
}

// Each part must be able to hold its share. Returns the share.
std::uint64_t check_sizes(const GridFile& f, std::uint64_t wanted) {
  const std::uint64_t share = wanted / std::max<std::size_t>(1, f.parts.size());
  if (f.parts.empty() || share * f.parts.size() != wanted)
    throw InputError(f.name + ": " + std::to_string(f.parts.size()) + " data files do not divide " +
                     std::to_string(wanted) + " bytes of voxels evenly");
  for (std::size_t i = 0; i < f.parts.size(); ++i) {
    const std::uint64_t most = most_bytes(f, f.parts[i].bytes.size());
    const std::uint64_t voxels = most - std::min(most, f.skip);
    if (voxels < share)
      truncated(f, i, share, (f.encoding == Encoding::raw ? "" : "at most ") + std::to_string(voxels));
  }
  return share;
}

std::shared_ptr<const void> voxels_of(GridFile& f) {
  const std::uint64_t wanted = stored_bytes(f), share = check_sizes(f, wanted);
  if (f.encoding == Encoding::raw && f.parts.size() == 1) {
    const FilePart& part = f.parts[0];
    if (const std::uint64_t rest = part.bytes.size() - f.skip - wanted; rest > 0)
      f.notes.push_back(std::to_string(rest) + " bytes behind the voxels are not used");
    return {part.file, part.bytes.data() + f.skip};
  }
  const std::size_t lead = f.skip <= longest_lead && f.parts.size() == 1 ? f.skip : 0;
  const std::size_t room = (lead + voxel_alignment - 1) / voxel_alignment * voxel_alignment;
  const auto memory = allocate_voxels(room + wanted, f.name);
  std::byte* out = static_cast<std::byte*>(memory.get()) + room;
  bool more = false;
  for (std::size_t i = 0; i < f.parts.size(); ++i) {
    const Found found = decode(f, f.parts[i].bytes, {out + i * share, share}, lead);
    if (found.bytes < share) truncated(f, i, share, std::to_string(found.bytes));
    more = more || found.more;
  }
  if (more) f.notes.push_back("the file holds further data behind the voxels, which is not used");
  return {memory, out};
}

std::string hash(const GridFile& f) {
  std::vector<BytesIn> files{f.header->bytes()};
  const MappedFile* last = f.header.get();
  for (const FilePart& part : f.parts) {
    if (part.file.get() != last) files.push_back(part.file->bytes());
    last = part.file.get();
  }
  return sha256(files);
}

}  // namespace

std::uint64_t stored_bytes(const GridFile& f) { return grid_bytes(f.dims, bytes_of(f.type), f.name); }

std::span<const std::byte> last_bytes(std::span<const std::byte> bytes, std::uint64_t wanted) {
  return bytes.last(std::min<std::uint64_t>(bytes.size(), wanted));
}

void flip_world(Affine& to_world, const Vector3& sign) {
  for (std::size_t r = 0; r < 3; ++r) {
    if (sign[r] > 0) continue;
    for (std::size_t c = 0; c < 3; ++c) to_world.m[3 * r + c] = 0 - to_world.m[3 * r + c];  // 0 - x: no negative zero
    to_world.t[r] = 0 - to_world.t[r];
  }
}

std::shared_ptr<const Field> load_grid_file(GridFile f, const LoadContext& context) {
  check_sizes(f, stored_bytes(f));  // before the hash reads everything
  auto fingerprint = std::async(std::launch::async, hash, std::cref(f));
  const auto grid = std::make_shared<GridField>();
  for (std::size_t a = 0; a < 3; ++a) grid->dims[a] = static_cast<int>(f.dims[a]);
  grid->to_world = f.to_world;
  grid->anatomical = f.anatomical;
  grid->length_unit = f.length_unit;
  grid->slope = f.slope;
  grid->intercept = f.intercept;
  grid->source = f.name;
  const bool swap = f.swap && f.encoding != Encoding::ascii;
  const std::shared_ptr<const void> voxels = voxels_of(f);
  grid->notes = f.notes;
  set_voxels(*grid, {f.type, swap, voxels}, f.name);
  finish_grid(*grid, context.nan_policy, context.nan_value);
  grid->sha256 = fingerprint.get();
  return grid;
}

std::uint64_t grid_file_bytes(const GridFile& f) {
  const std::uint64_t stored = stored_bytes(f);
  const bool decoded = f.encoding != Encoding::raw || f.parts.size() > 1;
  const bool swap = f.swap && f.encoding != Encoding::ascii;
  return (decoded ? stored : 0) + set_voxels_bytes(f.type, swap, stored / bytes_of(f.type));
}

}  // namespace dvrlab
