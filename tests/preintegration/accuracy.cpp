#include "tests/preintegration/accuracy.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dvrlab::test {

namespace {
using preintegrated::OutputChannel;
using preintegrated::Table;
using Kind = OutputChannel::Kind;
constexpr double fp32_half_ulp = 0x1p-24;

int extinction_of(const TableRequest& r, int column) {
  return r.rgb_extinction ? r.columns[std::size_t(column)].channel : 0;
}

// Of all outputs: [output][i * n + j].
std::vector<std::vector<double>> defined_outputs(const Cells& cells, const TableRequest& r, double h) {
  const std::size_t n = std::size_t(cells.grid.n);
  std::vector<std::vector<double>> all(r.outputs.size(), std::vector<double>(n * n, 0.0));
  const auto fill = [&](const SourceColumn& source, int e, const auto& take) {
    for (std::size_t i = 0; i < n; ++i)
      for (std::size_t j = 0; j < n; ++j) take(i * n + j, defined_entry(cells, source, e, h, int(i), int(j)));
  };
  for (int c = 0; c < int(r.columns.size()); ++c)
    fill(r.columns[std::size_t(c)], extinction_of(r, c), [&](std::size_t at, const Entry& entry) {
      for (std::size_t o = 0; o < all.size(); ++o) {
        if (r.outputs[o].index != c) continue;
        if (r.outputs[o].kind == Kind::total) all[o][at] = entry.C;
        if (r.outputs[o].kind == Kind::back) all[o][at] = entry.B;
        if (r.outputs[o].kind == Kind::second) all[o][at] = entry.second;
        if (r.outputs[o].kind == Kind::third) all[o][at] = entry.third;
      }
    });
  for (std::size_t o = 0; o < all.size(); ++o)
    if (r.outputs[o].kind == Kind::transmittance)
      fill(SourceColumn{}, r.outputs[o].index, [&](std::size_t at, const Entry& entry) { all[o][at] = entry.T; });
  return all;
}

double worse(double worst, double error) {  // a NaN is the worst
  return error <= worst ? worst : std::isnan(error) ? std::numeric_limits<double>::infinity() : error;
}
}  // namespace

EntryOf entries_of(const Table& table) {
  return [&table](int i, int j, int output) { return double(table.at(i, j, output)); };
}

double worst_error(const EntryOf& entry, const Cells& cells, const TableRequest& request, double h) {
  const int n = cells.grid.n;
  const auto defined = defined_outputs(cells, request, h);
  double worst = 0;
  for (std::size_t o = 0; o < defined.size(); ++o) {
    const double scale = *std::max_element(defined[o].begin(), defined[o].end());
    // Every further power of the position adds two sums and a product to a step of the slide.
    const Kind kind = request.outputs[o].kind;
    const double roundings = kind == Kind::second ? 6 : kind == Kind::third ? 9 : 3;
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const double x = defined[o][std::size_t(i * n + j)];
        const double allowed = fp32_half_ulp * x + roundings * n * 0x1p-53 * scale + std::numeric_limits<float>::min();
        worst = worse(worst, std::abs(entry(i, j, int(o)) - x) / allowed);
      }
    }
  }
  return worst;
}

double worst_ratio_error(const EntryOf& entry, const Cells& cells, const TableRequest& request, double h) {
  const int n = cells.grid.n;
  const auto defined = defined_outputs(cells, request, h);
  double worst = 0;
  for (std::size_t o = 0; o < defined.size(); ++o) {
    const OutputChannel& output = request.outputs[o];
    if (output.kind == Kind::zero) continue;
    const SourceColumn& source = request.columns[std::size_t(output.index)];
    std::vector<Approximation> approximate;
    double scale = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n; ++j) {
        approximate.push_back(approximate_entry(cells, source, extinction_of(request, output.index), h, i, j));
        scale = std::max(scale, approximate.back().C);
      }
    for (int i = 0; i < n; ++i) {
      for (int j = 0; j < n; ++j) {
        const std::size_t at = std::size_t(i * n + j);
        const double ratio = entry(i, j, int(o)), C = approximate[at].C;
        if (C > 1e-7 * scale) {
          const double allowed = fp32_half_ulp * defined[o][at] + 1e-9 * scale;
          worst = worse(worst, std::abs(ratio * C - defined[o][at]) / allowed);
        } else {
          worst = worse(worst, ratio >= 0 && std::isfinite(ratio) ? 0 : std::numeric_limits<double>::quiet_NaN());
        }
      }
    }
  }
  return worst;
}

preintegrated::BuildMeans means(const std::string& isa, int threads) { return {DVRLAB_TABLE_MODULES, isa, threads}; }

TableRequest full_request(bool rgb, bool ratio) {
  TableRequest r;
  r.rgb_extinction = rgb;
  r.ratio = ratio;
  for (int ch = 0; ch < 3; ++ch) r.columns.push_back({.E = true, .P = true, .channel = ch});
  for (int ch = 0; ch < 3; ++ch) r.columns.push_back({.S = true, .channel = ch});
  for (int ch = 0; ch < r.extinctions(); ++ch) r.columns.push_back({.W = true, .channel = ch});
  const auto add = [&](Kind kind, int first, int count) {
    for (int k = 0; k < count; ++k) r.outputs.push_back({kind, first + k});
  };
  add(Kind::total, 0, 3);
  if (ratio)
    r.outputs.push_back({});
  else
    add(Kind::transmittance, 0, r.extinctions());
  add(Kind::total, 3, 3 + r.extinctions());
  for (Kind kind : {Kind::back, Kind::second, Kind::third}) add(kind, 3, 3 + r.extinctions());
  while (r.outputs.size() % 4 != 0) r.outputs.push_back({});
  return r;
}

TableRequest plain_request(bool rgb) {
  TableRequest r;
  r.rgb_extinction = rgb;
  for (int ch = 0; ch < 3; ++ch) {
    r.columns.push_back({.E = true, .P = true, .channel = ch});
    r.outputs.push_back({Kind::total, ch});
  }
  r.outputs.push_back({Kind::transmittance, 0});
  return r;
}

}  // namespace dvrlab::test
