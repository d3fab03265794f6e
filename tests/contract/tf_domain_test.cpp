// Transfer functions in normalized and quantized values are those in physical values, written otherwise.
#include "framework/scene/tf_domain.h"

#include <cmath>
#include <cstdio>
#include <cstring>

#include "framework/config/experiment.h"
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

/// A grid of u8 or f32 voxels with stored values 0, 1, ... 128 (twice: 2 x 2 x 65).
std::shared_ptr<GridField> grid(double slope, double intercept, VoxelType type = VoxelType::u8) {
  auto g = std::make_shared<GridField>();
  g->dims = {2, 2, 65};
  g->type = type;
  const std::size_t count = 260;
  if (type == VoxelType::u8) {
    const auto voxels = std::make_shared<std::vector<std::uint8_t>>(count);
    for (std::size_t i = 0; i < count; ++i) (*voxels)[i] = std::uint8_t(i % 129);
    g->voxels = {voxels, voxels->data()};
  } else {
    const auto voxels = std::make_shared<std::vector<float>>(count);
    for (std::size_t i = 0; i < count; ++i) (*voxels)[i] = float(i % 129);
    g->voxels = {voxels, voxels->data()};
  }
  g->slope = slope;
  g->intercept = intercept;
  g->source = "test";
  finish_grid(*g, "error", 0);
  return g;
}

/// Nodes at u = 0, 1/8, 1/2, 3/4, 1, as values lo + u (hi - lo).
json model(double lo, double hi, const json& keys = json::object()) {
  const auto at = [&](double u) { return lo + u * (hi - lo); };
  json m = {{"type", "absorption_emission"},
            {"extinction", {{at(0), 0.0}, {at(0.125), 0.5}, {at(0.5), 0.25}, {at(0.75), 3.0}, {at(1), 1.0}}},
            {"color", {{at(0), 1.0, 0.0, 0.5}, {at(0.5), 0.25, 1.0, 0.0}, {at(1), 0.0, 0.5, 1.0}}}};
  m.update(keys);
  return m;
}

Scene scene_with(const json& optical_model, const std::shared_ptr<const Field>& field) {
  const json config = {{"data", {{"type", "procedural"}}},  // the field comes from the test
                       {"optical_model", optical_model},
                       {"estimator", {{"type", "direct"}}},
                       {"camera", {{"type", "perspective"}, {"position", {1.2, -2.0, 0.9}}}},
                       {"image", {{"size", {8, 8}}}}};
  const Experiment e = plan_experiment(parse_document(config.dump(), "test.json", "."), registry());
  return build_scene(e.cases.front().resolved, registry(), field);
}

std::vector<float> table_of(const Scene& scene) {
  for (const Buffer& b : scene.job.frame.buffers) {
    if (b.name != "medium_table") continue;
    std::vector<float> values(b.bytes() / sizeof(float));
    std::memcpy(values.data(), b.data.get(), b.bytes());
    return values;
  }
  throw std::logic_error("the scene has no table");
}

/// The largest difference of two tables relative to the largest entry.
double difference(const std::vector<float>& a, const std::vector<float>& b) {
  EXPECT_EQ(a.size(), b.size());
  double worst = 0, largest = 0;
  for (std::size_t i = 0; i < a.size(); ++i) {
    worst = std::max(worst, std::abs(double(a[i]) - double(b[i])));
    largest = std::max(largest, std::abs(double(b[i])));
  }
  return worst / largest;
}

struct Written {
  const char* name;
  json keys;   // of the domain
  double top;  // the nodes are written in 0 .. top
  double slope, intercept;
  double lo, hi;  // physical values of 0 and top
};
void PrintTo(const Written& w, std::ostream* out) { *out << w.name; }

// Every factor is a power of two, so the conversion is exact and the tables have the same bits.
class TfDomainBits : public testing::TestWithParam<Written> {};

TEST_P(TfDomainBits, EqualPhysicalValues) {
  const Written& w = GetParam();
  const auto field = grid(w.slope, w.intercept);
  const std::vector<float> other = table_of(scene_with(model(0, w.top, w.keys), field)),
                           same = table_of(scene_with(model(w.lo, w.hi), field)),
                           mirrored = table_of(scene_with(model(w.hi, w.lo + (w.hi - w.lo) * 2), field));
  EXPECT_EQ(std::memcmp(other.data(), same.data(), same.size() * sizeof(float)), 0) << difference(other, same);
  EXPECT_GT(difference(other, mirrored), 0.1) << "negative control: the same nodes one range further";
}

INSTANTIATE_TEST_SUITE_P(
    , TfDomainBits,
    testing::Values(
        Written{"normalized_data", {{"tf_domain", "normalized"}}, 1, 0.5, -16, -16, 48},
        Written{"normalized_data_negative_slope", {{"tf_domain", "normalized"}}, 1, -0.5, 32, -32, 32},
        Written{"normalized_given", {{"tf_domain", "normalized"}, {"tf_domain_range", {-64, 64}}}, 1, 1, -64, -64, 64},
        Written{"quantized_type", {{"tf_domain", "quantized"}, {"tf_domain_range", "type"}}, 255, 0.5, 8, 8, 135.5},
        Written{"quantized_type_negative_slope",
                {{"tf_domain", "quantized"}, {"tf_bits", 8}, {"tf_domain_range", "type"}},
                255,
                -0.5,
                8,
                -119.5,
                8},
        Written{"quantized_12_bits",
                {{"tf_domain", "quantized"}, {"tf_bits", 12}, {"tf_domain_range", {-4095, 4095}}},
                4095,
                2,
                -100,
                -4095,
                4095}),
    [](const auto& instance) { return instance.param.name; });

// Factors that fp64 rounds: nodes move by some 2^-52 of the range, table entries are rounded to fp32 once, so they may
// come to lie one unit in the last place apart.
TEST(TfDomain, EqualPhysicalValuesUpToRounding) {
  for (const double slope : {0.3, -0.7}) {
    const auto field = grid(slope, 7.1);
    const double a = 7.1, b = slope * 128 + 7.1;
    const json physical = model(std::min(a, b), std::max(a, b));
    const double normalized = difference(table_of(scene_with(model(0, 1, {{"tf_domain", "normalized"}}), field)),
                                         table_of(scene_with(physical, field)));
    const double quantized =
        difference(table_of(scene_with(model(0, 1023, {{"tf_domain", "quantized"}, {"tf_bits", 10}}), field)),
                   table_of(scene_with(physical, field)));
    std::printf("slope %g: tables differ by %.2g and %.2g of their largest entry\n", slope, normalized, quantized);
    EXPECT_LE(normalized, std::ldexp(1.0, -23));
    EXPECT_LE(quantized, std::ldexp(1.0, -23));
  }
}

// Surface terms are per unit of the transfer function's value, whatever that unit is.
TEST(TfDomain, SurfaceTermsAreConverted) {
  Medium medium;
  medium.interval.push_back({0, 255, {}});
  medium.interval[0].c[std::size_t(column(Term::tau_s, 0))] = {2, 0, 0};
  const auto field = grid(-0.5, 8);
  const auto stored = [&](const json& keys) {
    const json config = model(0, 255, keys);
    const Experiment e =
        plan_experiment(parse_document(json({{"data", {{"type", "procedural"}}},
                                             {"optical_model", config},
                                             {"estimator", {{"type", "direct"}}},
                                             {"camera", {{"type", "perspective"}, {"position", {1, 1, 1}}}}})
                                           .dump(),
                                       "test.json", "."),
                        registry());
    const TfDomain d = tf_domain(e.cases.front().resolved.optical_model.parameters, *field);
    return medium.rescaled(d.slope(*field), d.intercept(*field)).at(10)[std::size_t(column(Term::tau_s, 0))];
  };
  EXPECT_DOUBLE_EQ(stored({{"tf_domain", "physical"}}), 2 * 0.5);
  EXPECT_DOUBLE_EQ(stored({{"tf_domain", "quantized"}, {"tf_domain_range", "type"}}), 2.0);
  EXPECT_DOUBLE_EQ(stored({{"tf_domain", "normalized"}, {"tf_domain_range", "type"}}), 2.0 / 255);
}

std::string refusal(const json& keys, const std::shared_ptr<const Field>& field) {
  try {
    scene_with(model(0, 1, keys), field);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

TEST(TfDomain, Refusals) {
  const json type = {{"tf_domain", "normalized"}, {"tf_domain_range", "type"}};
  EXPECT_EQ(refusal(type, grid(1, 0)), "");
  EXPECT_NE(refusal(type, grid(1, 0, VoxelType::f32)).find("optical_model.tf_domain_range: \"type\" needs voxels"),
            std::string::npos);
  auto formula = std::make_shared<FormulaField>();
  EXPECT_NE(refusal(type, formula).find("this field is a formula"), std::string::npos);
  auto constant = grid(2, 1);
  constant->stored_min = constant->stored_max = 3;
  EXPECT_NE(refusal({{"tf_domain", "normalized"}}, constant).find("all values of the data are 7"), std::string::npos);
  EXPECT_EQ(refusal({{"tf_domain", "normalized"}, {"tf_domain_range", {0, 7}}}, constant), "");
}

TEST(TfDomain, IsSaidAloud) {
  const Scene s = scene_with(model(0, 15, {{"tf_domain", "quantized"}, {"tf_bits", 4}}), grid(-0.5, 32));
  const auto said = [&](const std::string& note) {
    return std::find(s.notes.begin(), s.notes.end(), note) != s.notes.end();
  };
  EXPECT_TRUE(said("optical_model.tf_domain: quantized: 0 to 15 are the physical values -32 to 32"))
      << testing::PrintToString(s.notes);
}

// The table's range stays physical.
TEST(TfDomain, TableRangeStaysPhysical) {
  const auto field = grid(0.5, -16);
  const json range = {{"tf_range", {-8, 24}}};
  json normalized = model(0, 1, {{"tf_domain", "normalized"}}), physical = model(-16, 48);
  normalized.update(range);
  physical.update(range);
  const std::vector<float> a = table_of(scene_with(normalized, field)), b = table_of(scene_with(physical, field)),
                           whole = table_of(scene_with(model(-16, 48), field));
  EXPECT_EQ(std::memcmp(a.data(), b.data(), a.size() * sizeof(float)), 0);
  EXPECT_GT(difference(a, whole), 0.1) << "negative control: without tf_range";
}

TEST(TfDomain, ImagesHaveTheSameBits) {
  json physical = {{"data",
                    {{"type", "procedural"},
                     {"field", "marschner_lobb"},
                     {"size", {24, 20, 22}},
                     {"voxel_type", "uint8"},
                     {"range", {-16, 111.5}},
                     {"offset", -16},
                     {"scale", 100}}},
                   {"optical_model", model(-16, 111.5)},
                   {"estimator", {{"type", "direct"}}},
                   {"camera", {{"type", "perspective"}, {"position", {1.2, -2.0, 0.9}}}},
                   {"image", {{"size", {24, 20}}}}};
  json quantized = physical;
  quantized["optical_model"] = model(0, 255, {{"tf_domain", "quantized"}, {"tf_domain_range", "type"}});
  json wrong = quantized;
  wrong["optical_model"]["tf_domain_range"] = "data";
  const FrameImage a = render(physical, targets()[0]).image;
  EXPECT_EQ(differing_values(a, render(quantized, targets()[0]).image), 0u);
  EXPECT_GT(differing_values(a, render(wrong, targets()[0]).image), 0u) << "negative control: another range";
}

}  // namespace
}  // namespace dvrlab::test
