// Bad inputs, made by hand: each gives exactly one error line that names the place and the fix, exit code 2 or 3, and
// no image.
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/front/front_test.h"

namespace dvrlab::front {
namespace {

namespace fs = std::filesystem;

struct BadInput {
  const char* name;
  std::string arguments;  // of the program; {} is the folder of the files
  std::vector<std::pair<std::string, std::string>> files;
  std::vector<std::string> words;  // in the one error line: the place, what was found, the fix
  int exit_code = 2;
};

/// A config with a line of its own for what is wrong, line 9.
std::string config(const std::string& line) { return small_config(",\n" + line + "\n"); }

/// A config whose data section is this one.
std::string with_data(const std::string& data) {
  const std::string all = small_config();
  const std::size_t begin = all.find("\"data\""), end = all.find("\"optical_model\"");
  return all.substr(0, begin) + "\"data\": " + data + ",\n  " + all.substr(end);
}

BadInput wrong_config(const char* name, const std::string& text, std::vector<std::string> words) {
  return {name, "validate {}/c.json", {{"c.json", text}}, std::move(words)};
}

BadInput wrong_file(const char* name, const std::string& type, const std::string& file, const std::string& bytes,
                    std::vector<std::string> words, const std::string& keys = "") {
  return {name,
          "render {}/c.json -o {}/image.png",
          {{"c.json", with_data(R"({"type": ")" + type + R"(", "file": ")" + file + "\"" + keys + "}")}, {file, bytes}},
          std::move(words)};
}

const std::string nrrd = "NRRD0005\ntype: uchar\ndimension: 3\nencoding: raw\nsizes: ";

const std::vector<BadInput>& bad_inputs() {
  static const std::vector<BadInput> all = {
      // the config as a text
      {"config_missing", "render {}/none.json -o {}/a.png", {}, {"none.json", "does it exist?"}},
      wrong_config("config_empty", "", {"c.json:1:1", "not valid JSON"}),
      wrong_config("config_is_a_list", "[1, 2]", {"c.json", "a config is a section {...}"}),
      wrong_config("config_comma", "{\n  \"seed\": 1,,\n}", {"c.json:2:13", "not valid JSON"}),
      wrong_config("config_duplicate_key", config("  \"seed\": 1, \"seed\": 2"),
                   {"c.json:10:14: seed", "duplicate key", "c.json:10:3", "keep one"}),
      wrong_config("config_unknown_key", config("  \"sampling\": {\"stpe\": 1}"),
                   {"c.json:10:16: sampling.stpe", "did you mean 'step'?", "legal:"}),
      wrong_config("config_unknown_section", config("  \"ilumination\": []"),
                   {"c.json:10:3: ilumination", "did you mean 'illumination'?"}),
      wrong_config("config_wrong_type", config("  \"sampling\": {\"step\": \"fine\"}"),
                   {"c.json:10:16: sampling.step", "found \"fine\"", "a number in (0,inf)"}),
      wrong_config("config_out_of_range", config("  \"limits\": {\"memory\": 0}"),
                   {"c.json:10:14: limits.memory", "found 0", "a number of at least 1"}),
      wrong_config("config_wrong_choice", config("  \"sampling\": {\"unit\": \"voxels\"}"),
                   {"c.json:10:16: sampling.unit", "did you mean 'voxel'?", "one of voxel, world"}),
      wrong_config("config_not_a_section", config("  \"sampling\": 3"),
                   {"c.json:10:3: sampling", "found 3", "must be a section"}),
      wrong_config("config_include_missing", config("  \"include\": \"none.json\""),
                   {"c.json:10:3: include", "none.json", "does it exist?"}),
      {"config_includes_itself",
       "validate {}/c.json",
       {{"c.json", config("  \"include\": \"d.json\"")}, {"d.json", "{\"include\": \"c.json\"}"}},
       {"include", "includes itself"}},
      wrong_config("config_key_of_two_lines", config("  \"a\\nb\": 1"), {"c.json:10:3: a\\nb: unknown key 'a\\nb'"}),
      wrong_config("config_key_empty", config("  \"\": 1"), {"c.json:10:3", "found the key \"\""}),
      wrong_config("config_number_too_large", "{\"seed\": 1e400}", {"c.json:1:", "number overflow"}),
      wrong_config("config_include_of_a_device", config("  \"include\": \"/dev/zero\""),
                   {"c.json:10:3: include", "no regular file"}),
      // plugins and their values
      wrong_config("plugin_unknown", with_data(R"({"type": "nrd", "file": "a.nrrd"})"),
                   {"c.json:3:12: data.type", "no data 'nrd' was found", "did you mean 'nrrd'?"}),
      wrong_config("plugin_without_type", with_data(R"({"file": "a.nrrd"})"),
                   {"c.json:3:3: data", "'type' is missing", "nrrd"}),
      wrong_config("key_required", with_data(R"({"type": "nrrd"})"),
                   {"c.json:3:3: data", "'file' is missing", "must be a text"}),
      wrong_config("key_of_another_choice", with_data(R"({"type": "procedural", "field": "constant", "omega": 3})"),
                   {"c.json:3:55: data.omega", "is read only where field is sinusoid", "here it is constant"}),
      wrong_config("bounds_inverted", with_data(R"({"type": "procedural", "bounds": [[1,1,1],[0,0,0]]})"),
                   {"c.json:3:34: data.bounds", "is no box", "below"}),
      wrong_config("size_too_small", with_data(R"({"type": "procedural", "size": [1, 64, 64]})"),
                   {"c.json:3:34: data.size", "in [2,16384]"}),
      {"tf_does_not_ascend",
       "validate {}/c.json --set 'optical_model.color=[[1,0,0,0],[0,1,1,1]]'",
       {{"c.json", small_config()}},
       {"--set: optical_model.color", "node 1", "values must ascend"}},
      // cameras, planes and lights that point nowhere
      {"camera_up_parallel",
       "validate {}/c.json --set camera.up=[0,0,2]",
       {{"c.json", small_config()}},
       {"--set: camera.up", "parallel to the view direction", "give another direction"}},
      wrong_config("clip_normal_zero", config("  \"clip\": [{\"normal\": [0, 0, 0]}]"),
                   {"c.json:10:13: clip[0].normal", "is 0", "give a direction"}),
      wrong_config("light_direction_zero",
                   config("  \"lights\": [{\"type\": \"directional\", \"direction\": [0, 0, 0]}]"),
                   {"c.json:10:38: lights[0].direction", "is 0", "give a direction"}),
      wrong_config("too_many_lights",
                   config("  \"lights\": [{\"type\":\"head\"},{\"type\":\"head\"},{\"type\":\"head\"},"
                          "{\"type\":\"head\"},{\"type\":\"head\"}]"),
                   {"c.json:10:3: lights", "found 5 lights", "at most 4"}),
      wrong_config("precision_of_the_cpu", config("  \"precision\": \"fast\""),
                   {"c.json:10:3: precision", "\"cpu\" has no \"fast\"", "use \"strict\""}),
      {"fp64_on_vulkan",
       "validate {}/c.json --set backend.type=vulkan",
       {{"c.json", config("  \"precision\": \"fp64\"")}},
       {"c.json:10:3: precision", "\"vulkan\" has no \"fp64\"", "in double for the cpu only", "\"cpu\""}},
      {"fp64_on_opengl",
       "validate {}/c.json --set backend.type=opengl",
       {{"c.json", config("  \"precision\": \"fp64\"")}},
       {"c.json:10:3: precision", "\"opengl\" has no \"fp64\"", "in double for the cpu only"}},
      {"fp64_with_an_isa",
       "validate {}/c.json --set backend.isa=avx2",
       {{"c.json", config("  \"precision\": \"fp64\"")}},
       {"c.json:10:3: precision", "for every processor", "backend.isa at \"auto\""}},
      wrong_config("cells_in_fp32", config("  \"sampling\": {\"type\":\"cells\"}"),
                   {"sampling.type", "walks in double only", "precision to \"fp64\""}),
      // experiments
      wrong_config("axis_empty", config("  \"axes\": {\"permutation\": {\"sampling.step\": []}}"),
                   {"c.json:10:28: axes.permutation.sampling.step", "not empty", "log2"}),
      wrong_config("axis_key_unknown", config("  \"axes\": {\"permutation\": {\"sampling.stp\": [1, 2]}}"),
                   {"c.json:10:28: axes.permutation.sampling.stp", "did you mean 'step'?"}),
      wrong_config("axis_role_unknown", config("  \"axes\": {\"permutations\": {}}"),
                   {"c.json:10:12: axes.permutations", "legal: permutation, variant"}),
      wrong_config("too_many_cases",
                   config("  \"axes\": {\"permutation\": {\"seed\": {\"lin\": [0, 9999, 10000]}, \"sampling.step\": "
                          "{\"lin\": [1, 2, 11]}}}"),
                   {"c.json:10:3: axes", "more than 100000 cases"}),
      wrong_config("expectation_without_reference",
                   config("  \"metrics\": [\"psnr\"], \"expect\": [{\"metric\": \"psnr\", \"against\": \"truth\", "
                          "\"at_least\": 40}]"),
                   {"c.json:10:35: expect[0]", "no reference 'truth'", "there is none"}),
      // data files
      wrong_config("file_missing", with_data(R"({"type": "nrrd", "file": "none.nrrd"})"),
                   {"c.json:3:28: data.file", "none.nrrd"}),
      wrong_config("environment_unset", with_data(R"({"type": "nrrd", "file": "${DVRLAB_NOT_SET}/a.nrrd"})"),
                   {"c.json:3:28: data.file", "DVRLAB_NOT_SET"}),
      wrong_file("file_empty", "nrrd", "a.nrrd", "", {"a.nrrd", "is empty"}),
      wrong_file("file_of_another_format", "nrrd", "a.nrrd", "P6 1 1 255", {"a.nrrd", "is no NRRD file"}),
      wrong_file("nrrd_field_misspelt", "nrrd", "a.nrrd", nrrd + "2 2 2\nspcings: 1 1 1\n\n12345678",
                 {"a.nrrd: line 6", "spcings", "the nearest is \"spacings\""}),
      wrong_file("nrrd_truncated", "nrrd", "a.nrrd", nrrd + "4 4 4\n\n12345678",
                 {"a.nrrd", "64 bytes of voxels", "holds 8", "cut off"}),
      wrong_file("nrrd_dims_overflow", "nrrd", "a.nrrd", nrrd + "2147483647 2147483647 2147483647\n\n1",
                 {"a.nrrd", "overflow"}),
      wrong_file("nrrd_of_a_later_version", "nrrd", "a.nrrd", "NRRD0009" + nrrd.substr(8) + "2 2 2\n\n12345678",
                 {"a.nrrd: line 1 is \"NRRD0009\"", "NRRD0001 to NRRD0005"}),
      wrong_file("nrrd_spacing_zero", "nrrd", "a.nrrd", nrrd + "2 2 2\nspacings: 1 0 1\n\n12345678",
                 {"a.nrrd: line 6, field \"spacings\"", "is 0 along axis 2"}),
      wrong_file("nrrd_direction_zero", "nrrd", "a.nrrd",
                 nrrd + "2 2 2\nspace dimension: 3\nspace directions: (1,0,0) (0,1,0) (0,0,0)\n\n12345678",
                 {"a.nrrd: line 7, field \"space directions\"", "axis 3 is (0,0,0)"}),
      wrong_file("metaimage_spacing_zero", "metaimage", "a.mha",
                 "ObjectType = Image\nNDims = 3\nDimSize = 2 2 2\nElementSpacing = 1 1 0\nElementType = MET_UCHAR\n"
                 "ElementDataFile = LOCAL\n12345678",
                 {"a.mha: line 4", "ElementSpacing", "is 0 along axis 3"}),
      wrong_file("vti_spacing_zero", "vti", "a.vti",
                 "<VTKFile type=\"ImageData\"><ImageData WholeExtent=\"0 1 0 1 0 1\" Spacing=\"1 0 1\"/></VTKFile>",
                 {"a.vti", "<ImageData>", "Spacing holds a 0"}),
      wrong_file("number_beyond_float", "nrrd", "a.nrrd",
                 "NRRD0005\ntype: double\ndimension: 3\nencoding: ascii\nsizes: 2 2 2\n\n1 1 1 1 1 1e300 1 1\n",
                 {"a.nrrd: voxel (1, 0, 1) is 1e+300", "beyond what float32 holds"}),
      wrong_file("nrrd_zero_sized", "nrrd", "a.nrrd", nrrd + "0 4 4\n\n1", {"a.nrrd", "at least 2 grid points"}),
      wrong_file("nrrd_of_colours", "nrrd", "a.nrrd",
                 "NRRD0005\ntype: uchar\ndimension: 4\nsizes: 3 2 2 2\nkinds: RGB-color domain domain domain\n"
                 "encoding: raw\n\n123456781234567812345678",
                 {"a.nrrd", "line 3", "scalar"}),
      wrong_file("nrrd_gzip_damaged", "nrrd", "a.nrrd",
                 "NRRD0005\ntype: uchar\ndimension: 3\nencoding: gzip\nsizes: 2 2 2\n\n\x1f\x8bgarbage garbage",
                 {"a.nrrd", "damaged"}),
      wrong_file("nifti_garbage", "nifti", "a.nii", std::string(400, 'x'), {"a.nii", "is no NIfTI file"}),
      // the command line
      {"verb_misspelt", "rendr {}/c.json", {}, {"rendr", "render"}},
      {"output_type", "render {}/c.json -o {}/a.gif", {{"c.json", small_config()}}, {"a.gif", ".exr or .png"}},
      {"set_without_value",
       "validate {}/c.json --set step",
       {{"c.json", small_config()}},
       {"--set step", "key.path=value"}},
      {"pixel_outside", "probe {}/c.json --pixel 99,0", {{"c.json", small_config()}}, {"--pixel", "99,0", "8 x 6"}},
      {"memory_too_little",
       "render {}/c.json -o {}/a.png --set limits.memory=100",
       {{"c.json", small_config()}},
       {"needs", "limits.memory allows", "raise limits.memory"},
       3},
      {"plugin_path_missing", "list --plugin-path {}/none", {}, {"--plugin-path", "there is no folder"}},
      {"tolerance_negative",
       "compare {}/a.exr {}/b.exr --tolerance -1",
       {},
       {"--tolerance", "found -1", "a number of at least 0"}},
      {"output_folder_missing",
       "render {}/c.json -o {}/none/a.png",
       {{"c.json", small_config()}},
       {"there is no folder"}},
      {"set_include",
       "validate {}/c.json --set include=d.json",
       {{"c.json", small_config()}},
       {"read from files only"}},
      {"compare_missing", "compare {}/a.exr {}/b.exr", {}, {"a.exr"}},
      {"kind_unknown", "list estimater", {}, {"estimater", "did you mean 'estimator'?"}},
  };
  return all;
}

class OneLine : public testing::TestWithParam<std::size_t> {};

TEST_P(OneLine, NamesThePlaceAndTheFix) {
  const BadInput& bad = bad_inputs()[GetParam()];
  const std::string folder = testing::TempDir() + "/dvrlab_bad_" + bad.name;
  fs::remove_all(folder);
  fs::create_directories(folder);
  for (const auto& [name, bytes] : bad.files) std::ofstream(folder + "/" + name, std::ios::binary) << bytes;
  std::string arguments = bad.arguments;
  for (std::size_t at; (at = arguments.find("{}")) != std::string::npos;) arguments.replace(at, 2, folder);
  const std::string line = std::string(DVRLAB_PROGRAM) + " " + arguments + " >/dev/null 2>'" + folder + "/printed'";
  const int status = std::system(line.c_str());
  EXPECT_TRUE(WIFEXITED(status) && WEXITSTATUS(status) == bad.exit_code) << status;
  std::ifstream in(folder + "/printed");
  std::vector<std::string> errors;
  std::string all;
  for (std::string text; std::getline(in, text); all += text + "\n")
    if (text.starts_with("error: ")) errors.push_back(text);
  ASSERT_EQ(errors.size(), 1u) << all;
  expect_words(errors[0], bad.words);
  EXPECT_FALSE(bad.words.empty());
  for (const char* image : {"/image.png", "/a.png", "/a.gif"}) EXPECT_FALSE(fs::exists(folder + image));
}

std::vector<std::size_t> indices() {
  std::vector<std::size_t> all(bad_inputs().size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = i;
  return all;
}

INSTANTIATE_TEST_SUITE_P(BadInput, OneLine, testing::ValuesIn(indices()),
                         [](const auto& instance) { return std::string(bad_inputs()[instance.param].name); });

}  // namespace
}  // namespace dvrlab::front
