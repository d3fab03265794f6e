// Decompression on its own: both ways of gzip agree, members, ends, limits.
#include "framework/scene/bzip2.h"
#include "framework/scene/gzip.h"
#include "tests/data/test_data.h"

namespace dvrlab::test {
namespace {

std::span<const std::byte> view(const Bytes& b) { return {reinterpret_cast<const std::byte*>(b.data()), b.size()}; }

Bytes noise(std::size_t n) {
  Bytes v(n);
  std::uint32_t x = 1;
  for (char& c : v) c = static_cast<char>((x = x * 1664525 + 1013904223) >> 27);
  return v;
}

TEST(Unpack, PieceByPieceAndAtOnceAgree) {
  const Bytes data = noise(100000);
  for (const Bytes& packed : {gzip(data), zlib(data), gzip(data) + gzip(Bytes(7, 'x')), gzip(data) + Bytes(5, 'z')}) {
    Bytes slow(data.size() + 7), fast(data.size() + 7);
    const std::span slow_out(reinterpret_cast<std::byte*>(slow.data()), slow.size());
    const auto unpacker = gzip_unpacker(view(packed), "test");
    const std::size_t n = unpacker->fill(slow_out);
    EXPECT_FALSE(unpacker->more());
    const std::span out(reinterpret_cast<std::byte*>(fast.data()), n);
    EXPECT_TRUE(gunzip_exactly(view(packed), out));
    EXPECT_EQ(slow, fast);
    EXPECT_EQ(Bytes(slow.begin(), slow.begin() + 100000), data);
    // The negative controls: one byte too much or too little room, one byte of the stream missing.
    EXPECT_FALSE(gunzip_exactly(view(packed), {out.data(), n - 1}));
    EXPECT_FALSE(gunzip_exactly(view(packed), {out.data(), n + 1}));
    if (packed.back() != 'z') {
      EXPECT_FALSE(gunzip_exactly(view(packed).first(packed.size() - 1), out));
    }
  }
}

TEST(Unpack, AnEndWithoutChecksumIsAnError) {
  const Bytes data = noise(1000);
  for (const Bytes& packed : {gzip(data), zlib(data)}) {
    Bytes out(data.size());
    const auto unpacker = gzip_unpacker(view(packed).first(packed.size() - 3), "where");
    EXPECT_EQ(unpacker->fill({reinterpret_cast<std::byte*>(out.data()), out.size()}), data.size());
    EXPECT_EQ(out, data);
    try {
      unpacker->more();
      ADD_FAILURE() << "a cut-off end was accepted";
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find("where: the compressed data is cut off"), std::string::npos) << e.what();
    }
  }
}

TEST(Unpack, SkipStopsAtTheEnd) {
  const Bytes packed = bzip2(noise(10000));
  EXPECT_EQ(bzip2_unpacker(view(packed), "")->skip(9999), 9999u);
  EXPECT_EQ(bzip2_unpacker(view(packed), "")->skip(10001), 10000u);
  const auto both = bzip2(noise(10)) + bzip2(noise(20));
  EXPECT_EQ(bzip2_unpacker(view(both), "")->skip(100), 30u);
}

// No file may hold more than the limits say, or good ones would be refused: zeros compress best.
TEST(Unpack, LimitsHoldForZeros) {
  for (const std::size_t n : {std::size_t{1}, std::size_t{1000}, std::size_t{1} << 26}) {
    const Bytes zeros(n, 0);
    const Bytes by_gzip = gzip(zeros), by_zlib = zlib(zeros), by_bzip2 = bzip2(zeros);
    EXPECT_GE(gunzip_limit(by_gzip.size()), n);
    EXPECT_GE(gunzip_limit(by_zlib.size()), n);
    EXPECT_GE(bunzip2_limit(by_bzip2.size()), n);
    std::printf("%zu zeros: gzip %zu, zlib %zu, bzip2 %zu bytes\n", n, by_gzip.size(), by_zlib.size(), by_bzip2.size());
  }
  EXPECT_GT(bunzip2_limit(~0ull), 1ull << 62);  // saturates
}

}  // namespace
}  // namespace dvrlab::test
