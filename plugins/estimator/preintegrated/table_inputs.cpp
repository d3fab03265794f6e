#include "plugins/estimator/preintegrated/table_inputs.h"

#include <algorithm>
#include <cmath>
#include <cstdint>

namespace dvrlab::preintegrated {

static_assert(most_columns == DVR_TABLE_MOST_COLUMNS && 4 * most_groups == DVR_TABLE_MOST_CHANNELS);

namespace {
constexpr std::size_t pad = DVR_TABLE_PAD;
// Of a column's brightest segments. What is left when bright cells leave the window is right to about n 1e-16 of their
// light; C / C_approx of something as dark would be noise.
constexpr double ratio_noise = 1e-10;

using Columns = std::array<std::vector<double>, medium_columns>;

std::vector<double> sum_of(const Columns& of, const SourceColumn& source, bool surface) {
  std::vector<double> r(of[std::size_t(column(Term::E, 0))].size(), 0.0);
  const auto add = [&](bool wanted, Term t) {
    if (!wanted) return;
    const auto& from = of[std::size_t(column(t, source.channel))];
    for (std::size_t k = 0; k < r.size(); ++k) r[k] += from[k];
  };
  add(!surface && source.E, Term::E);
  add(!surface && source.P, Term::P);
  add(source.S, surface ? Term::S_s : Term::S_l);
  add(source.W, surface ? Term::W_s : Term::W_l);
  return r;
}

double dirac_source(const CellDirac& d, const SourceColumn& s) {
  return (s.S ? d.c[std::size_t(s.channel)] : 0.0) + (s.W ? 1.0 : 0.0);
}
}  // namespace

double* TableInputs::padded(std::size_t count) { return memory_.emplace_back(count + 2 * pad, 0.0).data() + pad; }

double* TableInputs::copy(const std::vector<double>& values, bool mirrored) {
  double* r = padded(values.size());
  if (mirrored)
    std::copy(values.rbegin(), values.rend(), r);
  else
    std::copy(values.begin(), values.end(), r);
  return r;
}

dvr_table_prefix TableInputs::prefix(const std::vector<double>& values) {
  if (std::all_of(values.begin(), values.end(), [](double x) { return x == 0.0; })) return {nullptr, nullptr};
  double *const hi = padded(values.size() + 1), *const lo = padded(values.size() + 1);
  double h = 0, l = 0;
  for (std::size_t k = 0; k < values.size() + 1 + pad; ++k) {
    hi[k] = h;
    lo[k] = l;
    if (k >= values.size()) continue;
    // Knuth's exact sum: h + values[k] = sum + error.
    const double sum = h + values[k], part = sum - h;
    l += (h - (sum - part)) + (values[k] - part);
    h = sum + l;
    l -= h - sum;
  }
  return {hi, lo};
}

void TableInputs::add_diracs(const Cells& cells, const TableRequest& request) {
  const std::size_t count = cells.dirac.size();
  double* u = padded(count);
  std::array<double*, 3> mu{};
  for (int e = 0; e < job_.extinctions; ++e) job_.dirac_mu[e] = mu[std::size_t(e)] = padded(count);
  std::vector<double*> source;
  for (int c = 0; c < job_.columns; ++c) job_.dirac_source[c] = source.emplace_back(padded(count));
  for (std::size_t i = 0; i < count; ++i) {
    const CellDirac& d = cells.dirac[i];
    if (i == 0 || d.cell != cells.dirac[i - 1].cell) {
      dirac_first_.push_back(std::int32_t(i));
      dirac_at_.push_back(d.cell);
    }
    u[i] = d.u;
    for (std::size_t e = 0; e < std::size_t(job_.extinctions); ++e) mu[e][i] = d.mu[e];
    for (std::size_t c = 0; c < source.size(); ++c) source[c][i] = dirac_source(d, request.columns[c]);
  }
  dirac_first_.push_back(std::int32_t(count));
  job_.dirac_cells = std::int32_t(dirac_at_.size());
  job_.dirac_first = dirac_first_.data();
  job_.dirac_at = dirac_at_.data();
  job_.dirac_u = u;
}

void TableInputs::add_side(int direction, const Cells& cells, const TableRequest& request) {
  const bool mirrored = direction == 1;
  const std::size_t count = std::size_t(cells.grid.cells()), d = std::size_t(direction);
  dvr_table_side& side = job_.side[d];
  const auto ordered = [&](std::vector<double> v) {
    if (mirrored) std::reverse(v.begin(), v.end());
    return v;
  };
  for (int e = 0; e < job_.extinctions; ++e) {
    std::vector<double> surface = cells.integral[std::size_t(column(Term::tau_s, e))];
    for (const CellDirac& x : cells.dirac) surface[std::size_t(x.cell)] += x.mu[std::size_t(e)];
    side.length_depth[e] = prefix(ordered(cells.integral[std::size_t(column(Term::tau_l, e))]));
    side.surface_depth[e] = prefix(ordered(surface));
    side.at_extinction[e] = copy(cells.at_value[std::size_t(column(Term::tau_l, e))], mirrored);
  }
  for (int c = 0; c < job_.columns; ++c) {
    const SourceColumn& source = request.columns[std::size_t(c)];
    const auto length = sum_of(cells.integral, source, false);
    auto surface = sum_of(cells.integral, source, true);
    side.length_source[c] = copy(length, mirrored);
    side.surface_source[c] = copy(surface, mirrored);
    side.at_source[c] = copy(sum_of(cells.at_value, source, false), mirrored);
    const int e = job_.extinction_of[c];
    // Bound of the light of a segment: of the brightest cell's length part and of all cells' surface parts.
    double brightest = 0, surfaces = 0;
    for (std::size_t k = 0; k < count; ++k) {
      const double q = job_.h * job_.length_extinction[e][k];
      brightest = std::max(brightest, job_.h * length[k] * (q > 0 ? -std::expm1(-q) / q : 1.0));
      surfaces += surface[k] * (job_.surface_extinction[e][k] > 0
                                    ? -std::expm1(-job_.surface_extinction[e][k]) / job_.surface_extinction[e][k]
                                    : 1.0);
    }
    for (const CellDirac& x : cells.dirac) {
      const double mu = x.mu[std::size_t(e)];
      surfaces -= std::expm1(-mu) * dirac_source(x, source);
      surface[std::size_t(x.cell)] += mu * dirac_source(x, source);
    }
    job_.ratio_noise[c] = brightest + surfaces > 0 ? ratio_noise * (brightest + surfaces) : 1.0;
    if (request.ratio) {
      side.length_sum[c] = prefix(ordered(length));
      side.surface_sum[c] = prefix(ordered(surface));
    }
  }
  double* active = padded(count + 1);
  for (std::size_t k = 0; k < count + pad; ++k) {
    bool lit = false;
    for (int c = 0; c < job_.columns && k < count; ++c)
      lit = lit || side.length_source[c][k] != 0 || side.surface_source[c][k] != 0;
    for (const CellDirac& x : cells.dirac) lit = lit || std::size_t(x.cell) == (mirrored ? count - 1 - k : k);
    active[k + 1] = active[k] + (lit ? 1 : 0);
  }
  side.active = active;
  dirac_cell_[d].assign(count + 2 * pad, -1);
  dirac_near_[d].assign(count + 2 * pad, 0);
  for (std::size_t q = 0; q < dirac_at_.size(); ++q) {
    const std::size_t at = std::size_t(dirac_at_[q]), k = mirrored ? count - 1 - at : at;
    dirac_cell_[d][k + pad] = std::int32_t(q);
    for (std::size_t before = 0; before < pad; ++before) dirac_near_[d][k + pad - before] = 1;
  }
  side.dirac_cell = dirac_cell_[d].data() + pad;
  side.dirac_near = dirac_near_[d].data() + pad;
}

TableInputs::TableInputs(const Cells& cells, const TableRequest& request, double h) {
  job_.n = cells.grid.n;
  job_.h = h;
  job_.extinctions = request.extinctions();
  job_.columns = std::int32_t(request.columns.size());
  job_.groups = request.groups();
  job_.ratio = request.ratio ? 1 : 0;
  for (int c = 0; c < job_.columns; ++c) {
    job_.extinction_of[c] = request.rgb_extinction ? request.columns[std::size_t(c)].channel : 0;
    job_.moments[c] = request.moments(c);
  }
  for (std::size_t k = 0; k < request.outputs.size(); ++k) {
    using Kind = OutputChannel::Kind;
    const Kind kind = request.outputs[k].kind;
    job_.channel_kind[k] = kind == Kind::total           ? DVR_TABLE_TOTAL
                           : kind == Kind::back          ? DVR_TABLE_BACK
                           : kind == Kind::second        ? DVR_TABLE_SECOND
                           : kind == Kind::third         ? DVR_TABLE_THIRD
                           : kind == Kind::transmittance ? DVR_TABLE_TRANSMITTANCE
                                                         : DVR_TABLE_ZERO;
    job_.channel_index[k] = request.outputs[k].index;
  }
  for (int e = 0; e < job_.extinctions; ++e) {
    job_.length_extinction[e] = copy(cells.integral[std::size_t(column(Term::tau_l, e))], false);
    job_.surface_extinction[e] = copy(cells.integral[std::size_t(column(Term::tau_s, e))], false);
  }
  add_diracs(cells, request);
  for (int direction : {0, 1}) add_side(direction, cells, request);
}

}  // namespace dvrlab::preintegrated
