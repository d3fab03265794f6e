// Bad VTK ImageData files: one clear error each, and none that crashes.
#include <random>

#include "tests/data/vti_writer.h"

namespace dvrlab::test {
namespace {

class VtiErrors : public testing::Test {
 protected:
  void SetUp() override {
    const auto& all = registry().entries();
    if (std::none_of(all.begin(), all.end(), [](const auto& e) { return e.kind == "data" && e.name == "vti"; }))
      GTEST_SKIP() << "not supported: the vti plugin is not built (libexpat1-dev, liblz4-dev, liblzma-dev)";
  }
};

std::string error_of(const Bytes& bytes, nlohmann::json values = nlohmann::json::object()) {
  static int count = 0;
  const std::string file = scratch("bad" + std::to_string(++count) + ".vti");
  write(file, bytes);
  values["file"] = file;
  const std::string error = load_error("vti", values);
  std::filesystem::remove(file);
  EXPECT_TRUE(error.empty() || error.find("bad" + std::to_string(count) + ".vti") != std::string::npos) << error;
  EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  return error;
}

void expect_error(const Bytes& bytes, const std::string& part,
                  const nlohmann::json& values = nlohmann::json::object()) {
  const std::string error = error_of(bytes, values);
  EXPECT_NE(error.find(part), std::string::npos) << "wanted \"" << part << "\", got \"" << error << '"';
}

VtiArray ramp(const VtiCoding& c, const std::string& name = "v", int components = 1) {
  std::vector<std::uint16_t> v(24 * static_cast<std::size_t>(components));
  for (std::size_t i = 0; i < v.size(); ++i) v[i] = static_cast<std::uint16_t>(i * 300);
  return vti_array(name, "UInt16", v, c, components);
}

VtiFile small(const VtiCoding& c = {}) { return {c, "0 3 0 2 0 1", "", {{"0 3 0 2 0 1", "", {ramp(c)}}}}; }

Bytes replaced(const VtiFile& f, const std::string& from, const std::string& to) {
  const Bytes b = f.bytes();
  std::string text(b.begin(), b.end());
  const auto at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to) + Bytes();
}

TEST_F(VtiErrors, Xml) {
  expect_error({}, "is empty");
  expect_error("no xml at all" + Bytes(), "line 1 is no well-formed XML");
  expect_error("<VTKFile type=\"ImageData\">\n<ImageData" + Bytes(), "line 2 is no well-formed XML");
  expect_error("<!DOCTYPE a [<!ENTITY b \"c\">]><VTKFile/>" + Bytes(), "document type declaration");
  expect_error("<vtk/>" + Bytes(), "line 1: <vtk> is the root element");
  expect_error("<VTKFile/>" + Bytes(), "lacks the attribute type");
  expect_error("<VTKFile type=\"ImageData\"/>" + Bytes(), "holds no <ImageData>");
  expect_error("<VTKFile type=\"ImageData\"><Piece><PointData/></Piece></VTKFile>" + Bytes(), "holds no <ImageData>");
  expect_error("<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 0 1 0 1\"/></VTKFile>" + Bytes(),
               "holds no <Piece>");
  expect_error(replaced(small(), "\"ImageData\"", "\"UnstructuredGrid\""), "only ImageData, a regular grid");
  expect_error(replaced(small(), "\"ImageData\"", "\"PImageData\""), "a list of other files");
  expect_error(replaced(small(), "LittleEndian", "MiddleEndian"), "must be LittleEndian or BigEndian");
  expect_error(replaced(small(), "UInt32", "UInt16"), "must be UInt32 or UInt64");
  expect_error(replaced(small(), " header_type", " compressor=\"vtkZSTD\" header_type"), "compressor \"vtkZSTD\"");
  expect_error(replaced(small(), "\"ascii\"", "\"hex\""), "must be ascii, binary or appended");
  expect_error(replaced(small(), "\"UInt16\"", "\"String\""), "type \"String\" is no number");
}

TEST_F(VtiErrors, Geometry) {
  const auto extent = [](const std::string& whole, const std::string& piece) {
    VtiFile f = small();
    f.whole = whole;
    f.pieces[0].extent = piece;
    return f.bytes();
  };
  const auto grid = [](const std::string& attributes) {
    VtiFile f = small();
    f.grid = attributes;
    return f.bytes();
  };
  expect_error(extent("0 3 0 2", "0 3 0 2 0 1"), "must be 6 numbers");
  expect_error(extent("0 x 0 2 0 1", "0 3 0 2 0 1"), "\"x\" is no whole number");
  expect_error(extent("0 -1 0 -1 0 -1", "0 -1 0 -1 0 -1"), "a dimension is 0");
  expect_error(extent("0 3 0 2 0 0", "0 3 0 2 0 0"), "a dimension is 1");
  expect_error(extent("3 0 0 2 0 1", "3 0 0 2 0 1"), "a dimension is -2");
  expect_error(extent("0 2000000000 0 2000000000 0 2000000000", "0 3 0 2 0 1"), "overflow");
  expect_error(extent("0 99999999999 0 2 0 1", "0 3 0 2 0 1"), "no whole number of 32 bits");
  expect_error(extent("0 3 0 2 0 1", "0 4 0 2 0 1"), "does not lie in the WholeExtent");
  expect_error(extent("0 4 0 2 0 1", "0 3 0 2 0 1"), "leave a part of the WholeExtent \"0 4 0 2 0 1\" empty");
  expect_error(grid(R"(Spacing="1 0 1")"), "Spacing holds a 0");
  expect_error(grid(R"(Direction="1 1 0 0 0 0 0 0 1")"), "singular");
  expect_error(grid(R"(Spacing="1 inf 1")"), "is no finite number");
  expect_error(grid(R"(Origin="nan 0 0")"), "Origin: \"nan\" is no finite number");
  expect_error(grid(R"(Spacing="1 1")"), "must be 3 numbers");
  expect_error(grid(R"(Direction="1 0 0 0 1 0")"), "must be 9 numbers");
  VtiFile twice = small();
  twice.pieces.push_back(twice.pieces[0]);
  expect_error(twice.bytes(), "overlap");
}

TEST_F(VtiErrors, Choice) {
  VtiFile f = small();
  f.pieces[0].arrays.push_back(ramp({}, "other"));
  expect_error(f.bytes(), "choose one with data.array: \"v\", \"other\"");
  expect_error(f.bytes(), "the nearest is \"other\"; it has \"v\", \"other\"", {{"array", "othr"}});
  f.pieces[0].point_data = R"(Scalars="gone")";
  expect_error(f.bytes(), "its active array \"gone\" is not there");
  f.pieces[0].arrays = {ramp({}, "v", 3)};
  expect_error(f.bytes(), "choose one with data.component, 0 to 2", {{"array", "v"}});
  expect_error(f.bytes(), "data.component: is 3, but the array has 3 components", {{"array", "v"}, {"component", 3}});
  expect_error(small().bytes(), "has 1 component", {{"component", 1}});
  f.pieces[0].arrays.clear();
  expect_error(f.bytes(), "holds no point data");
  Bytes b = replaced(small(), "<PointData ", "<CellData ");
  std::string text(b.begin(), b.end());
  text.replace(text.find("</PointData>"), 12, "</CellData>");
  expect_error(text + Bytes(), "holds cell data only");
}

TEST_F(VtiErrors, Values) {
  VtiFile f = small();
  f.pieces[0].arrays[0].text += "5";
  expect_error(f.bytes(), "needs 24 numbers, its text holds more");
  f.pieces[0].arrays[0].text = std::string(30, '1') + " x" + std::string(40, ' ');
  expect_error(f.bytes(), "\"111111111111111111111111111111\", is no number of its type");
  f.pieces[0].arrays[0].text = "1 2 3                                                             ";
  expect_error(f.bytes(), "needs 24 numbers, its text holds 3");
  f.pieces[0].arrays[0].text = "1 -2 " + std::string(70, ' ');
  expect_error(f.bytes(), "number 1, \"-2\"");
  std::vector<float> v(24, 1.5f);
  v[9] = std::numeric_limits<float>::quiet_NaN();
  f.pieces[0].arrays = {vti_array("v", "Float32", v, {})};
  expect_error(f.bytes(), "voxel (1, 2, 0) is NaN");
  std::vector<double> huge(24, 1e300);
  f.pieces[0].arrays = {vti_array("v", "Float64", huge, {})};
  expect_error(f.bytes(), "beyond what float32 holds");
}

TEST_F(VtiErrors, Binary) {
  const VtiCoding raw{.format = "appended"}, inline64{.format = "binary"},
      packed{.format = "appended", .compressor = "vtkZLibDataCompressor"};
  const auto appended = [](const std::string& bytes, const std::string& rest = "") {
    return "<VTKFile type=\"ImageData\"" + rest +
           "><ImageData WholeExtent=\"0 3 0 2 0 1\"><Piece Extent=\"0 3 0 2 0 1\">"
           "<PointData><DataArray type=\"UInt8\" Name=\"v\" format=\"appended\" offset=\"0\"/></PointData></Piece>"
           "</ImageData><AppendedData encoding=\"raw\">" +
           bytes + Bytes();
  };
  const auto word = [](std::uint32_t x) {
    const Bytes b = bytes_of_numbers(std::vector<std::uint32_t>{x}, false);
    return std::string(b.begin(), b.end());
  };
  const std::string zlib = " compressor=\"vtkZLibDataCompressor\"";
  expect_error(replaced(small(raw), "offset=\"0\"", "offset=\"999999\""), "offset 999999 lies beyond");
  expect_error(replaced(small(raw), "offset=\"0\"", "offset=\"-1\""), "no whole number of at least 0");
  expect_error(appended("x"), "does not begin with \"_\"");
  expect_error(appended("_" + word(24) + "abc"), "needs 24 bytes, the file holds 3");
  expect_error(appended("_" + word(25) + std::string(25, 'x')), "needs 24 bytes, the file holds 25");
  expect_error(appended("_ab"), "the file ends inside the sizes");
  expect_error(appended("_" + word(0xffffffffu) + word(1) + word(0), zlib), "4294967295 compressed blocks");
  expect_error(appended("_" + word(1) + word(24) + word(0) + word(99), zlib), "more compressed bytes than the 0");
  expect_error(appended("_" + word(1) + word(23) + word(0) + word(4) + "abcd", zlib), "announces 23 bytes, not the 24");
  expect_error(appended("_" + word(2) + word(0xfffffff0u) + word(24) + word(4) + word(4) + "abcdefgh", zlib),
               "announces more bytes, not the 24");
  expect_error(appended("_" + word(1) + word(24) + word(0) + word(4) + "abcd", zlib),
               "block 0: the compressed data is");
  expect_error(appended("_" + word(0), zlib), "more than the file holds");
  expect_error(replaced(small(inline64), "MAAAAA", "M?AAAA"), "no base64");
  expect_error(replaced(small(inline64), "MAAAAA", "M=AAAA"), "no base64");
  // A bomb: more bytes than the compressed ones can hold, refused before memory is taken.
  const std::string whole = "WholeExtent=\"0 999 0 999 0 999\"", piece = "Extent=\"0 999 0 999 0 999\"";
  for (const std::string compressor : {"vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor"}) {
    Bytes b = appended("_" + word(1) + word(1000000000) + word(0) + word(30) + std::string(30, 'x'),
                       " compressor=\"" + compressor + "\"");
    std::string text(b.begin(), b.end());
    text.replace(text.find("WholeExtent=\"0 3 0 2 0 1\""), 25, whole);
    text.replace(text.find("<Piece Extent=\"0 3 0 2 0 1\"") + 7, 20, piece);
    expect_error(text + Bytes(), "announces 1000000000 bytes in the 30 bytes of block 0");
  }
}

// Cuts and spoilt bytes in every coding: an error or a volume, never a crash.
TEST_F(VtiErrors, CutAndSpoiltFiles) {
  std::mt19937 random(7);
  int refused = 0, read = 0;
  for (const std::string format : {"ascii", "binary", "appended"})
    for (const std::string encoding : {"raw", "base64"})
      for (const std::string compressor :
           {"", "vtkZLibDataCompressor", "vtkLZ4DataCompressor", "vtkLZMADataCompressor"}) {
        if (format != "appended" && encoding == "base64") continue;
        const VtiCoding c{format, encoding, compressor, false, 4, 20};
        const Bytes whole = small(c).bytes();
        ASSERT_EQ(error_of(whole), "");
        for (std::size_t n = 0; n + 60 < whole.size(); n += 1 + n / 64)
          EXPECT_NE(error_of(Bytes(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(n))), "") << n;
        for (int i = 0; i < 300; ++i) {
          Bytes spoilt = whole;
          spoilt[random() % spoilt.size()] = static_cast<char>(random());
          (error_of(spoilt).empty() ? read : refused) += 1;
        }
      }
  std::printf("spoilt files: %d refused, %d read\n", refused, read);
  EXPECT_GT(refused, read);
}

}  // namespace
}  // namespace dvrlab::test
