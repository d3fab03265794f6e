#include "framework/scene/mean_table.h"

#include "framework/scene/buffers.h"
#include "framework/scene/medium_bins.h"

namespace dvrlab {
namespace {

/// The groups of every bin, those outside the range included, with the surfaces' moment where it is asked for.
std::vector<std::vector<MediumGroup>> bin_groups(const Medium& medium, const MediumTableOptions& o, int bins,
                                                 bool barycentre) {
  const MediumLayout layout(medium, o);
  std::vector<MediumColumns> mean = bin_means(medium, o.lo, o.hi, bins);
  mean.insert(mean.begin(), medium.at(o.lo, true));
  mean.push_back(medium.at(o.hi));
  std::vector<double> offset = bin_surface_offsets(medium, o.lo, o.hi, bins);
  offset.insert(offset.begin(), 0.0);
  offset.push_back(0.0);
  std::vector<std::vector<MediumGroup>> groups;
  for (std::size_t j = 0; j < mean.size(); ++j) {
    groups.push_back(layout.groups(mean[j]));
    if (!barycentre) continue;
    double tau = 0;
    for (int c = 0; c < 3; ++c) tau += mean[j][static_cast<std::size_t>(column(Term::tau_s, c))] / 3;
    groups.back().push_back({tau * (static_cast<double>(j) - 0.5) + offset[j], tau, 0, 0});
  }
  return groups;
}

}  // namespace

void add_means(const Medium& medium, const MediumTableOptions& o, int bins, bool barycentre, KernelUnit& unit) {
  std::vector<float> table;
  std::vector<double> table64;
  if (bins > 0) {
    const auto groups = bin_groups(medium, o, bins, barycentre);
    std::vector<MediumGroup> sum(groups.front().size());
    for (std::size_t j = 0; j < groups.size(); ++j) {
      for (std::size_t g = 0; g < sum.size(); ++g) {
        for (double x : sum[g]) table.push_back(static_cast<float>(x));
        for (double x : sum[g]) table.push_back(static_cast<float>(x - static_cast<double>(static_cast<float>(x))));
        for (double x : groups[j][g]) table.push_back(static_cast<float>(x));
        // In double a sum is one number; what rounding took is nothing.
        table64.insert(table64.end(), sum[g].begin(), sum[g].end());
        table64.insert(table64.end(), {0, 0, 0, 0});
        table64.insert(table64.end(), groups[j][g].begin(), groups[j][g].end());
        // What lies below the range is never summed up: sums begin at its end.
        for (std::size_t k = 0; k < 4 && j > 0; ++k) sum[g][k] += groups[j][g][k];
      }
    }
  }
  unit.uniforms.insert(unit.uniforms.end(),
                       {Uniform::real("mean_lo", o.lo), Uniform::real("mean_scale", bins / (o.hi - o.lo)),
                        Uniform::real("mean_last", bins + 1),
                        Uniform::constant_integer("mean_barycentre", barycentre && bins > 0 ? 1 : 0)});
  unit.buffers.push_back(vec4_buffer("mean_table", std::move(table), std::move(table64)));
}

}  // namespace dvrlab
