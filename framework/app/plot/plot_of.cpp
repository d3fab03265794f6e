#include "framework/app/plot/plot_of.h"

#include <algorithm>
#include <filesystem>

#include "framework/interfaces/error.h"
#include "framework/scene/tf_domain.h"

namespace dvrlab {
namespace {

/// The choices that lead to the model: "optical_model=hybrid-2".
std::string title_of(const PlannedCase& c) {
  std::string title;
  for (const AxisChoice& choice : c.choices) {
    if (!choice.key.starts_with("optical_model")) continue;
    title += (title.empty() ? "" : ", ") + choice.key + " = " + choice.label;
  }
  return title;
}

/// The bars of a model are its own; dl_std and other numbers change none of them.
bool same_bars(const std::vector<TfBar>& a, const std::vector<TfBar>& b) {
  const auto same_nodes = [](const Nodes& x, const Nodes& y) {
    return std::equal(x.node.begin(), x.node.end(), y.node.begin(), y.node.end(),
                      [](const Node& p, const Node& q) { return p.value == q.value && p.x == q.x; });
  };
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [&](const TfBar& x, const TfBar& y) {
    return x.title == y.title && same_nodes(x.amount, y.amount) && same_nodes(x.color, y.color) &&
           std::equal(x.spikes.begin(), x.spikes.end(), y.spikes.begin(), y.spikes.end(),
                      [](const TfSpike& s, const TfSpike& t) {
                        return s.value == t.value && s.opacity == t.opacity && s.color == t.color;
                      });
  });
}

}  // namespace

Plot plot_of(const InfoReport& info, const Experiment* experiment) {
  const Field& field = *info.data.field;
  Plot plot;
  plot.title = std::filesystem::path(field.source).filename().string();
  plot.histogram = info.histogram;
  const PlannedCase* first = nullptr;
  if (experiment != nullptr) {
    for (const PlannedCase& c : experiment->cases) {
      if (!c.reference_name.empty()) continue;
      const ParameterSet& model = c.resolved.optical_model.parameters;
      if (first == nullptr) first = &c;
      for (const char* key : {"tf_domain", "tf_bits", "tf_domain_range"})
        if (model.json(key) != first->resolved.optical_model.parameters.json(key))
          throw InputError(model.path_of(key) + ": differs between the cases; --set " + model.path_of(key) +
                           "=... chooses one for the plot");
      PlotModel m{title_of(c), tf_bars(model)};
      const bool known = std::any_of(plot.models.begin(), plot.models.end(),
                                     [&](const PlotModel& other) { return same_bars(other.bars, m.bars); });
      if (!known && !m.bars.empty()) plot.models.push_back(std::move(m));
    }
  }
  if (plot.models.size() == 1) plot.models[0].title.clear();
  if (first != nullptr) {
    const TfDomain domain = tf_domain(first->resolved.optical_model.parameters, field);
    plot.slope = domain.top / (domain.hi - domain.lo);
    plot.intercept = domain.of_physical(0);
  }
  const double a = plot.slope * (field.slope * field.stored_min + field.intercept) + plot.intercept;
  const double b = plot.slope * (field.slope * field.stored_max + field.intercept) + plot.intercept;
  plot.lo = std::min(a, b);
  plot.hi = std::max(a, b);
  if (!(plot.hi > plot.lo)) plot.hi = plot.lo + 1;
  return plot;
}

}  // namespace dvrlab
