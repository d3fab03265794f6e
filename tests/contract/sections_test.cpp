// The framework's own keys keep their word like those of plugins: one that is declared to affect pixels must change the
// image, one for speed must not change a bit.
#include "framework/config/sections.h"

#include <cstdio>
#include <fstream>
#include <limits>

#include "framework/config/words.h"
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

/// A shaded, non-cubic volume in a world where no frame and no unit is that of another.
json base() {
  return {{"data",
           {{"type", "procedural"},
            {"field", "marschner_lobb"},
            {"size", {20, 18, 16}},
            {"bounds", {{-2, -1.5, -2}, {2, 2, 1}}}}},
          {"optical_model",
           {{"type", "absorption_emission"},
            {"shaded", true},
            {"opacity", {{0, 0}, {0.4, 0}, {0.6, 0.7}, {1, 0.8}}},
            {"color", {{0, 1, 0.8, 0.5}, {1, 0.4, 0.6, 0.9}}}}},
          {"estimator", {{"type", "direct"}}},
          {"lights", {{{"type", "head"}}}},
          {"illumination", {{{"type", "blinn_phong"}}}},
          {"camera", {{"type", "perspective"}, {"position", {1.6, -2.4, 1.4}}}},
          {"sampling", {{"type", "uniform"}, {"step", 0.7}}},
          {"image", {{"size", {24, 20}}}}};
}

/// A file with one value that is not a number.
std::string file_with_nan() {
  const std::string file = testing::TempDir() + "/sections_test_nan.nrrd";
  std::ofstream out(file, std::ios::binary);
  out << "NRRD0004\ntype: float\ndimension: 3\nsizes: 4 4 4\nendian: little\nencoding: raw\n\n";
  for (int k = 0; k < 64; ++k) {
    const float value = k == 21 ? std::numeric_limits<float>::quiet_NaN() : static_cast<float>(k) / 63;
    out.write(reinterpret_cast<const char*>(&value), sizeof value);
  }
  return file;
}

/// What a type needs beside its defaults to be seen.
json needed(const std::string& section, const std::string& type) {
  static const json table = {{"camera.perspective", {{"position", {1.6, -2.4, 1.4}}}},
                             {"camera.orthographic", {{"position", {1.6, -2.4, 1.4}}}},
                             {"camera.ray", {{"origin", {-2, 0.1, 0.2}}, {"direction", {1, 0.1, 0}}}},
                             {"lights.directional", {{"direction", {1, 0.3, 0.5}}}},
                             {"lights.point", {{"position", {3, -2, 1}}}},
                             {"sampling.cells", {{"tolerance", 1e-3}}},
                             {"clip.", {{"normal", {0, 0.3, 1}}, {"offset", 0.3}}}};
  return table.value(section + "." + type, json::object());
}

bool is_list(const std::string& section) { return section == "lights" || section == "clip"; }

json& place(json& config, const std::string& section) {
  if (section == "case") return config;
  return is_list(section) ? config[section][0] : config[section];
}

json example_of(const SectionType& s) {
  json config = base();
  json one = needed(s.section, s.type);
  if (*s.type != '\0') one["type"] = s.type;
  if (is_list(s.section)) {
    config[s.section] = json::array({one});
  } else if (*s.type != '\0') {
    config[s.section] = one;
  } else if (s.section == std::string("data")) {
    config["data"] = {{"type", "nrrd"}, {"file", file_with_nan()}};
  }
  return config;
}

struct Outcome {
  std::string refusal;  // "" when there is an image
  FrameImage image;
};

Outcome outcome_of(const json& config) {
  const json backend = config.value("backend", json{{"type", "cpu"}});
  try {
    return {"", render(config, Target{backend.at("type"), backend}).image};
  } catch (const InputError& e) {
    return {e.what(), {}};
  }
}

/// "" or how the key breaks its word. Throws NotSupported where it cannot be tried.
std::string broken_word(const SectionType& s, const Parameter& p) {
  if (p.live_value[0] == '\0') return "declares no live_value";
  json config = example_of(s);
  if (p.live_in[0] != '\0') {
    json patch = json::parse(p.live_in);
    if (is_list(s.section) && patch.contains(s.section)) {
      place(config, s.section).merge_patch(patch[s.section]);
      patch.erase(s.section);
    }
    config.merge_patch(patch);
  }
  if (p.default_value != nullptr && !place(config, s.section).contains(p.name))
    place(config, s.section)[p.name] = json::parse(p.default_value);
  json changed = config;
  place(changed, s.section)[p.name] = json::parse(p.live_value);
  if (config == changed) return "the live_value is the example's own value";
  const Outcome before = outcome_of(config), after = outcome_of(changed);
  // A policy may decide whether there is an image at all; everything else must show in one.
  const bool refusal_decides = s.section == std::string("data") && p.name == std::string("nan_policy");
  if (!before.refusal.empty() && !refusal_decides) return "the example is refused: " + before.refusal;
  if (!after.refusal.empty()) return "the live_value is refused: " + after.refusal;
  const bool same = before.refusal.empty() && before.image.width == after.image.width &&
                    before.image.height == after.image.height && differing_values(before.image, after.image) == 0;
  if (p.affects == Affects::pixels && same) return "is declared to affect pixels and changes none";
  if (p.affects == Affects::speed && !same) return "is declared to affect speed only and changes pixels";
  return "";
}

class EverySection : public testing::TestWithParam<std::size_t> {};

TEST_P(EverySection, KeysKeepTheirWord) {
  const SectionType& s = section_types()[GetParam()];
  int kept = 0, quiet = 0, fixed = 0, skipped = 0;
  for (const Parameter& p : s.keys) {
    if (p.affects == Affects::nothing || p.type == ParameterType::text) {  // texts name files and plugins
      ++skipped;
    } else if (p.type == ParameterType::choice && split_words(p.legal).size() == 1) {  // no second word yet
      ++fixed;
    } else {
      try {
        EXPECT_EQ(broken_word(s, p), "") << s.section << "." << s.type << "." << p.name;
        ++(p.affects == Affects::pixels ? kept : quiet);
      } catch (const NotSupported& reason) {
        std::printf("%s.%s.%s is not supported: %s\n", s.section, s.type, p.name, reason.what());
      }
    }
  }
  std::printf(
      "%s.%s: %d keys change the image, %d change no bit, %d have one legal word, %d decide nothing or name "
      "files\n",
      s.section, s.type, kept, quiet, fixed, skipped);
}

INSTANTIATE_TEST_SUITE_P(Framework, EverySection, testing::Range(std::size_t{0}, section_types().size()),
                         [](const auto& instance) {
                           const SectionType& s = section_types()[instance.param];
                           return std::string(s.section) + (*s.type != '\0' ? "_" : "") + s.type;
                         });

// `precision` has a third word beside the one that its declaration tries.
TEST(SectionLiveness, Fp64ChangesTheImageAndComesInDouble) {
  json config = base();
  const FrameImage strict = outcome_of(config).image;
  config["precision"] = "fp64";
  const Outcome fp64 = outcome_of(config);
  ASSERT_EQ(fp64.refusal, "");
  EXPECT_GT(differing_values(strict, fp64.image), 0u);
  EXPECT_LT(largest_difference(strict, fp64.image), 1e-3) << "it is the same picture";
  EXPECT_TRUE(strict.color64.empty() && strict.trans64.empty());
  ASSERT_EQ(fp64.image.color64.size(), fp64.image.color.size());
  ASSERT_EQ(fp64.image.trans64.size(), fp64.image.trans.size());
  std::size_t finer = 0;
  for (std::size_t k = 0; k < fp64.image.color.size(); ++k) {
    EXPECT_EQ(fp64.image.color[k], static_cast<float>(fp64.image.color64[k]));
    finer += static_cast<double>(fp64.image.color[k]) != fp64.image.color64[k];
  }
  EXPECT_GT(finer, fp64.image.color.size() / 4) << "more than fp32 can hold";
}

// Planted faults: keys that do not keep their word are seen.
TEST(SectionLiveness, SeesKeysThatBreakTheirWord) {
  const SectionType& top = *find_section_type("case", "");
  const SectionType& sampling = *find_section_type("sampling", "uniform");
  EXPECT_EQ(broken_word(top, {"repeat", ParameterType::integer, "", "1", "", "", Affects::pixels, "", "2"}),
            "is declared to affect pixels and changes none");
  EXPECT_EQ(broken_word(sampling, {"step", ParameterType::number, "", "1", "", "", Affects::speed, "", "0.5"}),
            "is declared to affect speed only and changes pixels");
  EXPECT_EQ(broken_word(sampling, {"step", ParameterType::number, "", "1", "", "", Affects::pixels, "", "1"}),
            "the live_value is the example's own value");
  EXPECT_NE(broken_word(sampling, {"step", ParameterType::number, "", "1", "", "", Affects::pixels, "", "-1"})
                .find("refused"),
            std::string::npos);
}

// Editors complete and check a structure only when its shape is declared.
TEST(Structures, EveryOneHasASchema) {
  int structures = 0;
  const auto check = [&](const std::string& where, const Parameter& p) {
    if (p.type != ParameterType::json) return;
    ++structures;
    EXPECT_TRUE(json::accept(p.schema)) << where << "." << p.name << " needs a JSON Schema (Parameter::schema)";
  };
  for (const SectionType& s : section_types())
    for (const Parameter& p : s.keys) check(std::string(s.section) + "." + s.type, p);
  for (const PluginEntryInfo& e : registry().entries())
    for (int k = 0; e.descriptor != nullptr && k < e.descriptor->parameter_count; ++k)
      check(e.kind + "." + e.name, e.descriptor->parameters[k]);
  EXPECT_GT(structures, 5);
}

}  // namespace
}  // namespace dvrlab::test
