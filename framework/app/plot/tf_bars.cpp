#include "framework/app/plot/tf_bars.h"

#include <algorithm>

namespace dvrlab {
namespace {

Vector3 linear(const Nodes& nodes, double v, const Vector3& without) {
  if (nodes.empty()) return without;
  const auto after = std::find_if(nodes.node.begin(), nodes.node.end(), [&](const Node& n) { return n.value > v; });
  if (after == nodes.node.begin()) return after->x;
  const Node& a = *(after - 1);
  if (after == nodes.node.end()) return a.x;
  const double w = (v - a.value) / (after->value - a.value);
  Vector3 x{};
  for (std::size_t c = 0; c < 3; ++c) x[c] = (1 - w) * a.x[c] + w * after->x[c];
  return x;
}

std::string group_of(const std::string& key) {
  const std::size_t dot = key.find('.');
  return dot == std::string::npos ? "" : key.substr(0, dot);
}

bool is_color(const Parameter& p) {
  return p.type == ParameterType::nodes && p.legal == std::string("3") && std::string(p.name).ends_with("color");
}

/// The colour nodes that belong to an amount of `group`: its own group's, else those outside groups.
std::string color_key(const ParameterSet& model, const std::string& group) {
  std::string shared;
  for (const Parameter& p : model.declared()) {
    if (!is_color(p) || model.is_null(p.name)) continue;
    if (group_of(p.name) == group) return p.name;
    if (group_of(p.name).empty() && shared.empty()) shared = p.name;
  }
  return shared;
}

std::vector<TfSpike> spikes_of(const ParameterSet& model, const std::string& key, const TfBar& bar) {
  std::vector<TfSpike> spikes;
  for (const nlohmann::json& d : model.json(key)) {
    TfSpike s{d.at("value").get<double>(), d.at("opacity").get<double>(), {}};
    s.color = d.contains("color") ? d.at("color").get<Vector3>() : color_at(bar, s.value);
    spikes.push_back(s);
  }
  return spikes;
}

}  // namespace

Vector3 amount_at(const TfBar& bar, double value) { return linear(bar.amount, value, {0, 0, 0}); }
Vector3 color_at(const TfBar& bar, double value) { return linear(bar.color, value, {1, 1, 1}); }

std::vector<TfBar> tf_bars(const ParameterSet& model) {
  std::vector<TfBar> bars;
  for (const Parameter& p : model.declared()) {
    if (p.type != ParameterType::nodes || is_color(p)) continue;
    const std::string name = p.name, group = group_of(name), color = color_key(model, group);
    TfBar bar;
    bar.amount = model.nodes(name);
    bar.title = name + (color.empty() ? "" : ", " + color);
    if (!color.empty()) bar.color = model.nodes(color);
    for (const Node& n : bar.amount.node)
      for (const double x : n.x) bar.top = std::max(bar.top, x);
    for (const Parameter& other : model.declared()) {
      if (other.name != group + ".delta" || group.empty()) continue;
      bar.spikes = spikes_of(model, other.name, bar);
      if (!bar.spikes.empty()) bar.title += ", " + std::string(other.name);
    }
    if (!bar.amount.empty() || !bar.spikes.empty()) bars.push_back(std::move(bar));
  }
  return bars;
}

}  // namespace dvrlab
