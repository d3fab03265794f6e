// case.json: the seven sections, named like the stages.
#include "framework/interfaces/plugin.h"
#include "framework/report/case_record.h"

namespace dvrlab {
namespace {

using nlohmann::json;

json plugins_of(const ResolvedCase& c) {
  json list = json::array();
  const auto add = [&](const Section& s) {
    if (s.plugin == nullptr) return;
    list.push_back({{"kind", s.plugin->kind},
                    {"name", s.plugin->name},
                    {"version", s.plugin->version},
                    {"citation", s.plugin->citation}});
  };
  for (const Section* s : {&c.data, &c.sampler, &c.optical_model, &c.estimator, &c.backend}) add(*s);
  for (const Section& s : c.illumination) add(s);
  for (const Section& s : c.metrics) add(s);
  return {{"abi", DVRLAB_ABI_TAG}, {"used", list}};
}

json backend_of(const CaseRecord& r) {
  json times = json::object();
  for (const PhaseStatistics& t : r.times) {
    times[t.phase] = {{"median_s", t.median}, {"interquartile_range_s", t.interquartile_range}};
    if (t.cpu_median >= 0) times[t.phase]["cpu_median_s"] = t.cpu_median;
  }
  json memory = json::object();
  for (const auto& [part, bytes] : r.memory) memory[part] = static_cast<std::uint64_t>(bytes);
  const ParameterSet& top = r.plan->resolved.top;
  return {{"device", r.device.device},
          {"driver", r.device.driver},
          {"api", r.device.api},
          {"detail", r.device.detail},
          {"seed", top.integer("seed")},
          {"counters",
           {{"samples", r.counters.samples},
            {"table_fetches", r.counters.table_fetches},
            {"skipped", r.counters.skipped},
            {"terminated", r.counters.terminated}}},
          {"memory_bytes", memory},
          {"repeats", top.integer("repeat")},
          {"times", times}};
}

json metrics_of(const CaseRecord& r) {
  json metrics = {{"against", json::object()}, {"expectations", json::array()}};
  for (const Measure& m : r.measures) {
    for (const auto& [name, value] : m.values) metrics["against"][m.against][name] = json_number(value);
  }
  if (r.variant) {
    metrics["variant"] = {{"first", r.variant->first},
                          {"max_abs", json_number(r.variant->max_abs)},
                          {"different_floats", r.variant->different}};
  }
  for (const ExpectationResult& e : r.expectations) {
    metrics["expectations"].push_back({{"expectation", e.text},
                                       {"value", e.value ? json_number(*e.value) : json()},
                                       {"verdict", verdict_text(e.verdict)},
                                       {"reason", e.reason}});
  }
  return metrics;
}

json image_of(const CaseRecord& r) {
  if (!r.ran) return json::object();
  return {{"exr", "image.exr"}, {"png", "image.png"}, {"size", r.plan->resolved.image.json("size")}};
}

}  // namespace

nlohmann::ordered_json case_json(const CaseRecord& r) {
  json choices = json::object(), references = json::object();
  for (const AxisChoice& c : r.plan->choices) choices[c.key] = c.label;
  return {{"config", r.plan->resolved.config},
          {"plugins", plugins_of(r.plan->resolved)},
          {"scene", r.scene},
          {"backend", backend_of(r)},
          {"image", image_of(r)},
          {"metrics", metrics_of(r)},
          {"report",
           {{"id", r.plan->id},
            {"role", r.plan->reference_name.empty() ? "case" : "reference"},
            {"choices", choices},
            {"verdict", verdict_text(r.verdict)},
            {"reason", r.reason}}}};
}

}  // namespace dvrlab
