// The contract of every discovered plugin: it has an example that renders, and every parameter keeps its word. One
// that is declared to affect pixels must change the image (a metric's: its numbers), one for speed must not change a
// bit.
#include <cstdio>
#include <filesystem>
#include <fstream>

#include "framework/config/key_pointer.h"
#include "framework/interfaces/metric.h"
#include "tests/support/render.h"

namespace dvrlab::test {
namespace {

using nlohmann::json;

const Target cpu{"cpu", {{"type", "cpu"}}};

std::string example_file(const PluginEntryInfo& e) { return e.folder + "/" + e.name + ".example.json"; }

json example_of(const PluginEntryInfo& e) {
  json c = json::parse(std::ifstream(example_file(e)), nullptr, true, true);
  c.erase("axes");
  c.erase("expect");
  c.erase("reference");
  c["base_folder"] = e.folder;
  return c;
}

/// The sections of `kind` in a config: illumination passes and metrics are lists.
json& section_of(json& config, const std::string& kind, const std::string& type) {
  if (kind != "illumination") return config[kind];
  for (json& pass : config["illumination"])
    if (pass.at("type") == type) return pass;
  throw std::logic_error("the example of " + type + " has no such pass");
}

/// Backends render on themselves, everything else on the cpu.
Target target_of(const PluginEntryInfo& e, const json& config) {
  return e.kind == "backend" ? Target{e.name, config.at("backend")} : cpu;
}

struct Count {
  int alive = 0, quiet = 0, skipped = 0;
};

// A parameter of a metric changes what the metric says of two different images.
void check_metric(const PluginEntryInfo& e, const Parameter& p, Count& count) {
  auto& metric = registry().get<MetricPlugin>("metric", e.name);
  json values = json::object();
  const std::vector<Parameter> declared(e.descriptor->parameters,
                                        e.descriptor->parameters + e.descriptor->parameter_count);
  for (const Parameter& d : declared) values[d.name] = json::parse(d.default_value);
  FrameImage a, b;
  a.width = b.width = 2;
  a.height = b.height = 1;
  a.color = {0.1f, 0.2f, 0.3f, 0.4f, 0.5f, 0.6f};
  b.color = {0.2f, 0.2f, 0.1f, 0.4f, 0.9f, 0.6f};
  a.trans = b.trans = {0.5f, 0.5f, 0.5f, 0.5f, 0.5f, 0.5f};
  const auto before = metric.compare(ParameterSet("metric", declared, values), a, b);
  values[p.name] = json::parse(p.live_value);
  const auto after = metric.compare(ParameterSet("metric", declared, values), a, b);
  EXPECT_NE(before, after) << "metric." << e.name << "." << p.name;
  ++count.alive;
}

void check_parameter(const PluginEntryInfo& e, const Parameter& p, Count& count) {
  const std::string what = e.kind + "." + e.name + "." + p.name;
  if (p.affects == Affects::nothing || p.type == ParameterType::text) {  // texts name files and devices
    ++count.skipped;
    return;
  }
  ASSERT_STRNE(p.live_value, "") << what << " declares no live_value";
  if (e.kind == "metric") return check_metric(e, p, count);
  json config = example_of(e);
  if (p.live_in[0] != '\0') {
    json patch = json::parse(p.live_in);
    // A patch for a pass addresses it by its kind; the list itself cannot be merged.
    if (e.kind == "illumination" && patch.contains("illumination")) {
      section_of(config, e.kind, e.name).merge_patch(patch["illumination"]);
      patch.erase("illumination");
    }
    config.merge_patch(patch);
  }
  json changed = config;
  section_of(changed, e.kind, e.name)[key_pointer(p.name)] = json::parse(p.live_value);
  ASSERT_NE(config, changed) << what << ": live_value is the example's own value";
  const FrameImage before = render(config, target_of(e, config)).image,
                   after = render(changed, target_of(e, changed)).image;
  if (p.affects == Affects::pixels) {
    const bool same =
        before.width == after.width && before.height == after.height && differing_values(before, after) == 0;
    EXPECT_FALSE(same) << what << " is declared to affect pixels and changes none";
    ++count.alive;
  } else {
    EXPECT_EQ(differing_values(before, after), 0u) << what << " is declared to affect speed only";
    ++count.quiet;
  }
}

class EveryPlugin : public testing::TestWithParam<std::size_t> {
 protected:
  const PluginEntryInfo& entry() const { return registry().entries()[GetParam()]; }
};

TEST_P(EveryPlugin, CanBeUsed) {
  EXPECT_EQ(entry().problem, "");
  ASSERT_NE(entry().descriptor, nullptr);
  EXPECT_EQ(entry().descriptor->name, entry().name);
  EXPECT_STRNE(entry().descriptor->summary, "");
  EXPECT_TRUE(std::filesystem::exists(entry().folder + "/" + entry().name + ".md")) << "no page for " << entry().name;
}

TEST_P(EveryPlugin, ExampleRenders) {
  ASSERT_TRUE(std::filesystem::exists(example_file(entry()))) << example_file(entry());
  const json config = example_of(entry());
  try {
    const FrameResult r = render(config, target_of(entry(), config));
    EXPECT_GT(r.counters.samples, 0u);
  } catch (const NotSupported& reason) {
    GTEST_SKIP() << "not supported: " << reason.what();
  }
}

TEST_P(EveryPlugin, ParametersKeepTheirWord) {
  const PluginEntryInfo& e = entry();
  Count count;
  try {
    for (int k = 0; k < e.descriptor->parameter_count; ++k) check_parameter(e, e.descriptor->parameters[k], count);
  } catch (const NotSupported& reason) {
    GTEST_SKIP() << "not supported: " << reason.what();
  }
  std::printf("%s/%s: %d parameters change the image, %d change no bit, %d name files, devices or nothing\n",
              e.kind.c_str(), e.name.c_str(), count.alive, count.quiet, count.skipped);
}

// A precondition of the tests above, and their negative control: a patch that no parameter reads changes nothing.
TEST(Liveness, SameConfigGivesSameBits) {
  for (const PluginEntryInfo& e : registry().entries()) {
    if (e.kind != "estimator") continue;
    const json config = example_of(e);
    EXPECT_EQ(differing_values(render(config, cpu).image, render(config, cpu).image), 0u) << e.name;
  }
}

std::vector<std::size_t> all_entries() {
  std::vector<std::size_t> r(registry().entries().size());
  for (std::size_t k = 0; k < r.size(); ++k) r[k] = k;
  return r;
}

INSTANTIATE_TEST_SUITE_P(Plugins, EveryPlugin, testing::ValuesIn(all_entries()), [](const auto& instance) {
  const PluginEntryInfo& e = registry().entries()[instance.param];
  return e.kind + "_" + e.name;
});

}  // namespace
}  // namespace dvrlab::test
