// The fetch primitives of the cpu kernel language against plain loops, for every element type and instruction set.
// The data lies between two pages that nobody may touch: a read before the first or behind the last element ends
// the process.
#include <gtest/gtest.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <new>
#include <random>

#include "tests/kernel/probes.h"

namespace dvrlab {
namespace {

using namespace kernel_test;

constexpr int reads = 1 << 12;

/// `count` elements that fill whole pages, with a forbidden page before and behind.
template <class T>
class Guarded {
 public:
  static constexpr int pages = 2;
  Guarded() : page_(std::size_t(sysconf(_SC_PAGESIZE))) {
    base_ = static_cast<std::byte*>(
        mmap(nullptr, (pages + 2) * page_, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    if (base_ == MAP_FAILED) throw std::bad_alloc();
    std::mt19937 random(11);
    for (std::size_t k = 0; k < count(); ++k) data()[k] = T(int(random() >> 8) - (1 << 23));
    mprotect(base_, page_, PROT_NONE);
    mprotect(base_ + (pages + 1) * page_, page_, PROT_NONE);
  }
  ~Guarded() { munmap(base_, (pages + 2) * page_); }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;
  T* data() const { return reinterpret_cast<T*>(base_ + page_); }
  std::size_t count() const { return pages * page_ / sizeof(T); }

 private:
  std::size_t page_;
  std::byte* base_;
};

/// Random indices in [0, last], and both ends in every lane.
std::vector<int> indices(std::size_t last) {
  std::mt19937 random(3);
  std::vector<int> i(reads);
  for (std::size_t k = 0; k < i.size(); ++k) {
    i[k] = int(random() % (last + 1));
    if (k / 16 % 3 == 1) i[k] = int(last);
    if (k / 16 % 3 == 2) i[k] = k % 2 == 0 ? 0 : int(last);
  }
  return i;
}

template <class T, int element>
void check_voxels() {
  const Guarded<T> data;
  const T* p = data.data();
  const auto value = [&](int i) { return float(p[std::uint32_t(i)]); };
  std::vector<float> out(8 * reads);
  for (const Isa& isa : isas()) {
    SCOPED_TRACE(isa.name);
    const std::vector<int> one = indices(data.count() - 1);
    isa.probe->fetch1(element, p, one.data(), out.data(), reads);
    for (std::size_t k = 0; k < reads; ++k) ASSERT_EQ(out[k], value(one[k])) << "fetch1, element " << one[k];

    const std::vector<int> two = indices(data.count() - 2);
    isa.probe->fetch2(element, p, two.data(), out.data(), reads);
    for (std::size_t k = 0; k < reads; ++k) {
      ASSERT_EQ(out[k], value(two[k])) << "fetch2, element " << two[k];
      ASSERT_EQ(out[reads + k], value(two[k] + 1)) << "fetch2, the element after " << two[k];
    }

    for (const int dy : {2, 3, 17}) {
      const int dz = 5 * dy + 1;
      const std::vector<int> base = indices(data.count() - std::size_t(dz + dy) - 2);
      isa.probe->fetch_cell(element, p, base.data(), dy, dz, out.data(), reads);
      for (std::size_t k = 0; k < reads; ++k)
        for (int c = 0; c < 8; ++c)
          ASSERT_EQ(out[std::size_t(c) * reads + k], value(base[k] + (c & 1) + (c >> 1 & 1) * dy + (c >> 2) * dz))
              << "fetch_cell, corner " << c << " of cell " << base[k];
    }
  }
}

TEST(KernelFetch, VoxelsUint8) { check_voxels<std::uint8_t, DVR_ELEMENT_U8>(); }
TEST(KernelFetch, VoxelsInt8) { check_voxels<std::int8_t, DVR_ELEMENT_I8>(); }
TEST(KernelFetch, VoxelsUint16) { check_voxels<std::uint16_t, DVR_ELEMENT_U16>(); }
TEST(KernelFetch, VoxelsInt16) { check_voxels<std::int16_t, DVR_ELEMENT_I16>(); }
TEST(KernelFetch, VoxelsFloat32) { check_voxels<float, DVR_ELEMENT_F32>(); }

// Records of a voxel and a 16-bit level, and eight bytes behind the last: the same corners as two separate fetches.
template <class T, int element>
void check_beside() {
  const Guarded<std::uint8_t> data;
  constexpr std::size_t record = sizeof(T) + 2, reach = 8;
  const std::size_t count = (data.count() - reach) / record;
  const std::uint8_t* p = data.data() + (data.count() - reach) % record;
  std::vector<float> out(16 * reads);
  for (const Isa& isa : isas()) {
    if (isa.probe->fetch_beside == nullptr) continue;
    SCOPED_TRACE(isa.name);
    for (const int dy : {2, 3, 17}) {
      const int dz = 5 * dy + 1;
      const std::vector<int> base = indices(count - std::size_t(dz + dy) - 2);
      isa.probe->fetch_beside(element, p, base.data(), dy, dz, out.data(), reads);
      for (std::size_t k = 0; k < reads; ++k)
        for (int c = 0; c < 8; ++c) {
          const std::uint8_t* at = p + std::size_t(base[k] + (c & 1) + (c >> 1 & 1) * dy + (c >> 2) * dz) * record;
          T value;
          std::uint16_t level;
          std::memcpy(&value, at, sizeof(T));
          std::memcpy(&level, at + sizeof(T), 2);
          ASSERT_EQ(out[std::size_t(c) * reads + k], float(value)) << "value, corner " << c << " of cell " << base[k];
          ASSERT_EQ(out[std::size_t(8 + c) * reads + k], float(level))
              << "level, corner " << c << " of cell " << base[k];
        }
    }
  }
}

TEST(KernelFetch, LevelsBesideUint8) { check_beside<std::uint8_t, DVR_ELEMENT_U8>(); }
TEST(KernelFetch, LevelsBesideInt8) { check_beside<std::int8_t, DVR_ELEMENT_I8>(); }
TEST(KernelFetch, LevelsBesideUint16) { check_beside<std::uint16_t, DVR_ELEMENT_U16>(); }
TEST(KernelFetch, LevelsBesideInt16) { check_beside<std::int16_t, DVR_ELEMENT_I16>(); }

TEST(KernelFetch, TableEntries) {
  const Guarded<float> data;
  const float* p = data.data();
  std::vector<float> out(4 * reads), w(reads);
  for (std::size_t k = 0; k < reads; ++k) w[k] = float(k) / reads;
  const std::vector<int> four = indices(data.count() / 4 - 1), eight = indices(data.count() / 8 - 1);
  const int last = int(data.count() / 4 - 1);
  for (const Isa& isa : isas()) {
    SCOPED_TRACE(isa.name);
    isa.probe->fetch4(p, four.data(), out.data(), reads);
    for (std::size_t k = 0; k < reads; ++k)
      for (std::size_t c = 0; c < 4; ++c) ASSERT_EQ(out[c * reads + k], p[4 * std::size_t(four[k]) + c]);

    isa.probe->fetch4_affine(p, eight.data(), w.data(), out.data(), reads);
    for (std::size_t k = 0; k < reads; ++k)
      for (std::size_t c = 0; c < 4; ++c) {
        const float* entry = p + 8 * std::size_t(eight[k]);
        const volatile float step = entry[4 + c] * w[k];  // no contraction
        ASSERT_EQ(out[c * reads + k], entry[c] + step) << "entry " << eight[k] << ", channel " << c;
      }

    for (const int entry : {0, last}) {
      isa.probe->fetch4u(p, entry, out.data(), reads);
      for (std::size_t c = 0; c < 4; ++c)
        ASSERT_TRUE(std::all_of(out.begin() + std::ptrdiff_t(c * reads), out.begin() + std::ptrdiff_t((c + 1) * reads),
                                [&](float x) { return x == p[4 * std::size_t(entry) + c]; }));
    }
  }
}

TEST(KernelFetch, WholeNumbers) {
  const Guarded<std::int32_t> words;
  const Guarded<std::uint8_t> bytes;
  const std::vector<int> i = indices(words.count() - 1), j = indices(bytes.count() - 1);
  std::vector<int> out(reads);
  for (const Isa& isa : isas()) {
    SCOPED_TRACE(isa.name);
    isa.probe->fetchi(words.data(), i.data(), out.data(), reads);
    for (std::size_t k = 0; k < reads; ++k) ASSERT_EQ(out[k], words.data()[i[k]]);
    isa.probe->fetchi8(bytes.data(), j.data(), out.data(), reads);
    for (std::size_t k = 0; k < reads; ++k) ASSERT_EQ(out[k], int(bytes.data()[j[k]]));
  }
}

}  // namespace
}  // namespace dvrlab
