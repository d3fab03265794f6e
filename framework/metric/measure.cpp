#include "framework/metric/measure.h"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>

#include "framework/interfaces/metric.h"
#include "framework/report/log.h"

namespace dvrlab {
namespace {

template <class Real>
void compare(const std::vector<Real>& a, const std::vector<Real>& b, VariantCheck& check) {
  if (a.size() != b.size()) {
    check.different += std::max(a.size(), b.size());
    check.max_abs = std::numeric_limits<double>::infinity();
    return;
  }
  for (std::size_t i = 0; i < a.size(); ++i) {
    if (std::memcmp(&a[i], &b[i], sizeof(Real)) == 0) continue;
    ++check.different;
    const double difference = std::abs(static_cast<double>(a[i]) - static_cast<double>(b[i]));
    check.max_abs =
        std::max(check.max_abs, std::isfinite(difference) ? difference : std::numeric_limits<double>::infinity());
  }
}

}  // namespace

std::vector<Measure> measure(const ResolvedCase& c, const Registry& registry, const FrameImage& image,
                             const FrameImage& reference, const std::string& against) {
  std::vector<Measure> measures;
  for (const Section& m : c.metrics) {
    const auto& plugin = registry.get<MetricPlugin>("metric", m.type);
    measures.push_back({against, m.type, plugin.compare(m.parameters, image, reference),
                        plugin.better() == MetricPlugin::Better::higher});
  }
  return measures;
}

VariantCheck compare_bits(const FrameImage& image, const FrameImage& first) {
  VariantCheck check;
  if (!image.color64.empty() && !first.color64.empty()) {
    compare(image.color64, first.color64, check);
    compare(image.trans64, first.trans64, check);
  } else {
    compare(image.color, first.color, check);
    compare(image.trans, first.trans, check);
  }
  return check;
}

Measurer::Measurer(const Experiment& experiment, const Registry& registry)
    : experiment_(experiment), registry_(registry) {
  for (std::size_t i = 0; i < experiment.cases.size(); ++i) {
    last_use_[experiment.cases[i].first_variant] = i;
    for (const auto& [name, index] : experiment.cases[i].references) last_use_[index] = i;
  }
}

namespace {
// An image that holds a NaN or an infinity is no result, whatever it equals.
void judge_finite(const FrameImage& image, CaseRecord& record) {
  std::size_t bad = 0, first = 0;
  for (std::size_t k = 0; k < image.color.size(); ++k) {
    if (std::isfinite(image.color[k]) && std::isfinite(image.trans[k])) continue;
    if (bad++ == 0) first = k / 3;
  }
  if (bad == 0) return;
  const std::size_t width = std::size_t(image.width);
  record.judge(Verdict::fail, std::to_string(bad) + " values of the image are not finite, first at pixel " +
                                  std::to_string(first % width) + "," + std::to_string(first / width) +
                                  "; the data's values or gradients exceed what fp32 can square");
}
}  // namespace

void Measurer::measure_case(std::size_t index, FrameImage image, CaseRecord& record) {
  const PlannedCase& c = experiment_.cases[index];
  judge_finite(image, record);
  const auto add = [&](const FrameImage& reference, const std::string& against) {
    for (Measure& m : measure(c.resolved, registry_, image, reference, against))
      record.measures.push_back(std::move(m));
  };
  for (const auto& [name, reference] : c.references) {
    const auto found = kept_.find(reference);
    if (found == kept_.end()) {
      log_line("metrics", c.id + ": not measured against '" + name + "', which has no image");
    } else {
      add(found->second.image, name);
    }
  }
  const auto first = kept_.find(c.first_variant);
  if (first == kept_.end()) {
    kept_.emplace(c.first_variant, Kept{c.id, std::move(image)});
    return;
  }
  add(first->second.image, "variant");
  record.variant = compare_bits(image, first->second.image);
  record.variant->first = first->second.id;
  if (record.variant->different > 0 && c.resolved.top.text("precision") != "fast") {
    record.judge(Verdict::fail, std::to_string(record.variant->different) + " numbers differ from " +
                                    record.variant->first + ", by at most " +
                                    json_number(record.variant->max_abs).dump() +
                                    "; variants must be equal to the bit");
  }
}

void Measurer::done(std::size_t index) {
  std::erase_if(kept_, [&](const auto& kept) { return last_use_.at(kept.first) <= index; });
}

}  // namespace dvrlab
