// EXR keeps every bit, PNG follows its rule, files appear complete or not at all.
#include <ImfArray.h>
#include <ImfChannelList.h>
#include <ImfDoubleAttribute.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfOutputFile.h>
#include <ImfStringAttribute.h>
#include <png.h>

#include <random>

#include "framework/image/image_io.h"
#include "tests/data/test_data.h"

namespace dvrlab {
namespace {

FrameImage noise(int width, int height) {
  FrameImage image{width, height, {}, {}};
  std::mt19937 random(7);
  for (int i = 0; i < 3 * width * height; ++i) {
    image.color.push_back(std::uniform_real_distribution<float>(0, 2)(random));
    image.trans.push_back(std::exp2(-std::uniform_real_distribution<float>(0, 40)(random)));  // small T too
  }
  return image;
}

TEST(Exr, KeepsEveryBit) {
  FrameImage image = noise(13, 7);
  image.color[5] = -0.0f;
  image.color[6] = std::numeric_limits<float>::denorm_min();
  image.trans[8] = 1e-30f;
  const std::string file = test::scratch("a.exr");
  write_exr(file, image, nlohmann::json{{"dvrlab.backend", "cpu"}, {"dvrlab.seconds", 0.25}});
  const FrameImage back = read_exr(file);
  EXPECT_EQ(back.width, 13);
  EXPECT_EQ(back.height, 7);
  EXPECT_EQ(std::memcmp(back.color.data(), image.color.data(), 4 * image.color.size()), 0);
  EXPECT_EQ(std::memcmp(back.trans.data(), image.trans.data(), 4 * image.trans.size()), 0);
  const Imf::InputFile in(file.c_str());
  EXPECT_EQ(in.header().typedAttribute<Imf::StringAttribute>("dvrlab.backend").value(), "cpu");
  EXPECT_EQ(in.header().typedAttribute<Imf::DoubleAttribute>("dvrlab.seconds").value(), 0.25);
  for (const char* name : {"R", "G", "B", "A", "AR", "AG", "AB", "TR", "TG", "TB"}) {
    const Imf::Channel* channel = in.header().channels().findChannel(name);
    ASSERT_TRUE(channel) << name;
    EXPECT_EQ(channel->type, Imf::FLOAT);
  }
}

// The alpha channels as another program sees them.
TEST(Exr, AlphaIsOneMinusT) {
  const FrameImage image = noise(5, 3);
  const std::string file = test::scratch("alpha.exr");
  write_exr(file, image, nlohmann::json::object());
  Imf::InputFile in(file.c_str());
  std::vector<float> a(15), ag(15);
  Imf::FrameBuffer buffer;
  buffer.insert("A", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(a.data()), 4, 20));
  buffer.insert("AG", Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(ag.data()), 4, 20));
  in.setFrameBuffer(buffer);
  in.readPixels(0, 2);
  for (std::size_t p = 0; p < 15; ++p) {
    EXPECT_EQ(ag[p], 1.0f - image.trans[3 * p + 1]);
    EXPECT_NEAR(a[p], 1 - (image.trans[3 * p] + image.trans[3 * p + 1] + image.trans[3 * p + 2]) / 3, 1e-6);
  }
}

TEST(Exr, FilesOfOtherPrograms) {
  const std::string file = test::scratch("other.exr");
  std::vector<float> rgba{1, 2, 3, 0.25f, 4, 5, 6, 0.5f};
  Imf::Header header(Imath::Box2i({0, 0}, {9, 9}), Imath::Box2i({3, -2}, {4, -2}));  // a crop: 2 x 1 at (3,-2)
  Imf::FrameBuffer buffer;
  for (const auto& [name, c] : {std::pair{"R", 0}, {"G", 1}, {"B", 2}, {"A", 3}}) {
    header.channels().insert(name, Imf::Channel(Imf::FLOAT));
    buffer.insert(
        name, Imf::Slice::Make(Imf::FLOAT, rgba.data() + c, Imath::V2i(3, -2), 2, 1, std::size_t{16}, std::size_t{32}));
  }
  {
    Imf::OutputFile out(file.c_str(), header);
    out.setFrameBuffer(buffer);
    out.writePixels(1);
  }
  const FrameImage image = read_exr(file);
  EXPECT_EQ(image.width, 2);
  EXPECT_EQ(image.color, (std::vector<float>{1, 2, 3, 4, 5, 6}));
  EXPECT_EQ(image.trans, (std::vector<float>{0.75f, 0.75f, 0.75f, 0.5f, 0.5f, 0.5f}));
}

TEST(Exr, ErrorsNameTheFile) {
  test::write(test::scratch("no.exr"), {'n', 'o'});
  for (const std::string& file : {test::scratch("no.exr"), test::scratch("missing.exr")}) {
    try {
      read_exr(file);
      FAIL();
    } catch (const InputError& e) {
      EXPECT_NE(std::string(e.what()).find(file), std::string::npos);
    }
  }
}

std::vector<int> read_png(const std::string& file, int& width, int& height) {
  png_image png{};
  png.version = PNG_IMAGE_VERSION;
  EXPECT_TRUE(png_image_begin_read_from_file(&png, file.c_str()));
  EXPECT_EQ(png.format, PNG_FORMAT_RGB);
  std::vector<unsigned char> bytes(PNG_IMAGE_SIZE(png));
  EXPECT_TRUE(png_image_finish_read(&png, nullptr, bytes.data(), 0, nullptr));
  width = static_cast<int>(png.width);
  height = static_cast<int>(png.height);
  return {bytes.begin(), bytes.end()};
}

TEST(Png, ClampsRoundsAndEncodes) {
  const float nan = std::numeric_limits<float>::quiet_NaN();
  const FrameImage image{
      2, 2, {-1, 0, 0.5f, 1, 2, nan, 0.001f, 0.0019f, 0.0020f, 0.2f, 0.7f, 0.99f}, std::vector<float>(12)};
  const std::string file = test::scratch("a.png");
  int width = 0, height = 0;
  write_png(file, image, false);
  EXPECT_EQ(read_png(file, width, height),
            (std::vector<int>{0, 0, 128, 255, 255, 0, 0, 0, 1, 51, 178, 252}));  // 0.7f < 0.7
  EXPECT_EQ(width, 2);
  EXPECT_EQ(height, 2);
  write_png(file, image, true);  // IEC 61966-2-1: 0.5 -> 188, 0.2 -> 124, 0.7 -> 218
  const std::vector<int> encoded = read_png(file, width, height);
  EXPECT_EQ(encoded[2], 188);
  EXPECT_EQ(encoded[9], 124);
  EXPECT_EQ(encoded[10], 218);
  EXPECT_EQ(encoded[6], 3);
}

TEST(Images, AreCompleteOrAbsent) {
  const std::string folder = test::scratch("images");
  std::filesystem::create_directory(folder);
  EXPECT_THROW(write_exr(folder + "/bad.exr", noise(2, 2), nlohmann::json{{"list", {1, 2}}}), std::runtime_error);
  EXPECT_THROW(write_png(folder + "/none/a.png", noise(2, 2), false), std::runtime_error);
  EXPECT_TRUE(std::filesystem::is_empty(folder));
  write_png(folder + "/a.png", noise(2, 2), false);
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(folder), {}), 1);
}

}  // namespace
}  // namespace dvrlab
