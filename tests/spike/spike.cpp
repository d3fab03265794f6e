#include "tests/spike/spike.h"

#include <bit>
#include <fstream>

#include "framework/config/document.h"
#include "framework/config/resolve.h"
#include "framework/interfaces/error.h"

namespace dvrlab::spike {
namespace {

std::unique_ptr<BackendSession> open(const std::string& backend, const std::string& isa) {
  const PluginEntryInfo& entry = registry().find("backend", backend);
  const PluginDescriptor& d = *entry.descriptor;
  const std::vector<Parameter> declared(d.parameters, d.parameters + d.parameter_count);
  nlohmann::json values = nlohmann::json::object();
  for (const Parameter& p : declared) values[p.name] = nlohmann::json::parse(p.default_value);
  if (!isa.empty()) values["isa"] = isa;
  return registry()
      .get<BackendPlugin>("backend", backend)
      .open(ParameterSet("backend", declared, values), entry.folder);
}

std::vector<Target> open_all() {
  std::vector<Target> all;
  const std::pair<const char*, const char*> wanted[] = {{"cpu", "scalar"}, {"cpu", "sse4.2"}, {"cpu", "avx2"},
                                                        {"cpu", "avx512"}, {"vulkan", ""},    {"opengl", ""}};
  for (const auto& [backend, isa] : wanted) {
    Target target{backend + (*isa != 0 ? std::string(" ") + isa : ""), nullptr, ""};
    try {
      target.session = open(backend, isa);
    } catch (const std::exception& e) {  // not built, no device, or an instruction set that is not there
      target.reason = e.what();
    }
    all.push_back(std::move(target));
  }
  return all;
}

std::size_t different_bits(const std::vector<float>& a, const std::vector<float>& b) {
  std::size_t n = a.size() == b.size() ? 0 : a.size();
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i)
    n += std::bit_cast<std::uint32_t>(a[i]) != std::bit_cast<std::uint32_t>(b[i]);
  return n;
}

double march_ms(const FrameResult& result) {
  for (const PhaseTime& t : result.times)
    if (t.phase == "march") return 1e3 * t.cpu_seconds;
  return -1;
}

}  // namespace

const Registry& registry() {
  static const Registry all({DVRLAB_SPIKE_PLUGINS});
  return all;
}

ResolvedCase resolve(const std::string& config) {
  const ConfigDocument document = parse_document(config, "spike", ".", {});
  Problems problems;
  ResolvedCase resolved = resolve_case(document.tree, document.base_folder, registry(), problems);
  problems.raise();
  return resolved;
}

Scene scene_of(const std::string& config) {
  const ResolvedCase c = resolve(config);
  return build_scene(c, registry(), FieldCache().load(c, registry()));
}

Scene scene_of(const std::string& config, std::shared_ptr<const Field> field) {
  return build_scene(resolve(config), registry(), std::move(field));
}

const std::vector<Target>& targets() {
  static const std::vector<Target> all = open_all();
  return all;
}

FrameResult render_everywhere(const std::string& what, const FrameJob& job, int repeats) {
  FrameResult first;
  std::string first_name;
  for (const Target& target : targets()) {
    if (!target.session) {
      std::printf("%-20s %-10s not supported: %s\n", what.c_str(), target.name.c_str(), target.reason.c_str());
      continue;
    }
    FrameResult result;
    double best = 0;
    for (int r = 0; r < repeats; ++r) {
      target.session->render(job, result);
      if (r == 0 || march_ms(result) < best) best = march_ms(result);
      if (r + 1 < repeats) result = {};
    }
    if (first_name.empty()) {
      first = result;
      first_name = target.name;
    }
    const std::size_t n =
        different_bits(first.image.color, result.image.color) + different_bits(first.image.trans, result.image.trans);
    std::printf("%-20s %-10s %8.1f CPU ms, %9llu segments, %zu values differ from %s\n", what.c_str(),
                target.name.c_str(), best, static_cast<unsigned long long>(result.counters.samples), n,
                first_name.c_str());
    EXPECT_EQ(n, 0u) << what << " on " << target.name;
    EXPECT_EQ(result.counters.samples, first.counters.samples) << what << " on " << target.name;
  }
  return first;
}

nlohmann::json golden(const std::string& id) {
  std::ifstream file(DVRLAB_GOLDEN);
  if (!file) return nullptr;
  const nlohmann::json all = nlohmann::json::parse(file);
  for (const auto& c : all.at("cases"))
    if (c.at("id") == id) return c;
  throw std::logic_error("no golden case " + id);
}

}  // namespace dvrlab::spike
