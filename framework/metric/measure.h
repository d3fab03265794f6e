// The metrics stage: images against their references and against the first variant.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "framework/config/experiment.h"
#include "framework/interfaces/backend.h"
#include "framework/plugin/registry.h"
#include "framework/report/case_record.h"

namespace dvrlab {

/// All metrics of the case, of `image` against `reference`. Throws what a metric throws.
std::vector<Measure> measure(const ResolvedCase& c, const Registry& registry, const FrameImage& image,
                             const FrameImage& reference, const std::string& against);

/// Compares every number of colour and transmittance: the doubles where both images have them, else the floats. Images
/// of different sizes differ in every number. A NaN differs by infinity unless both have the same bits.
VariantCheck compare_bits(const FrameImage& image, const FrameImage& first);

/// Measures the cases of an experiment in their running order and keeps the images that later ones are compared
/// with, no longer than that.
class Measurer {
 public:
  Measurer(const Experiment& experiment, const Registry& registry);
  /// Metrics against every reference and against the first variant; the verdict "fail" for a variant that differs
  /// in any precision but fast.
  void measure_case(std::size_t index, FrameImage image, CaseRecord& record);
  /// The case is through, with or without an image: forgets what no later case needs.
  void done(std::size_t index);
  /// Number of images that wait for later cases.
  std::size_t kept() const { return kept_.size(); }

 private:
  struct Kept {
    std::string id;
    FrameImage image;
  };
  const Experiment& experiment_;
  const Registry& registry_;
  /// By the index of a reference, or of the first variant of a permutation; where that one has no image, the first
  /// variant that has one stands in.
  std::map<std::size_t, Kept> kept_;
  std::map<std::size_t, std::size_t> last_use_;
};

}  // namespace dvrlab
