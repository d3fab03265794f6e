#include "plugins/estimator/preintegrated/cells.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "framework/interfaces/error.h"

namespace dvrlab::preintegrated {

namespace {
constexpr Term surface_terms[] = {Term::tau_s, Term::S_s, Term::W_s};

bool is_surface(int column_index) {
  return std::any_of(std::begin(surface_terms), std::end(surface_terms),
                     [&](Term t) { return column_index / 3 == static_cast<int>(t); });
}

double polynomial(const std::array<double, 3>& p, double t) { return p[0] + t * (p[1] + t * p[2]); }

// Simpson's rule is exact here, and its weights are positive: nothing cancels.
double mean(const std::array<double, 3>& p, double ta, double tb) {
  return (polynomial(p, ta) + 4 * polynomial(p, 0.5 * (ta + tb)) + polynomial(p, tb)) / 6;
}

void check(const Medium& medium, const CellGrid& grid) {
  std::ostringstream what;
  if (grid.n < 2 || !(grid.v_max > grid.v_min) || !std::isfinite(grid.width())) {
    what << "pre-integration table: " << grid.n << " values over [" << grid.v_min << ", " << grid.v_max
         << "] have no cells; give at least 2 values and a finite range whose upper end is larger";
    throw InputError(what.str());
  }
  const auto refuse = [&](double v, const std::string& term) {
    what << "pre-integration table: the medium's " << term << " at the value " << v
         << " is not finite; opaque intervals and isosurfaces must be taken out before (opaque: \"cap\" does it)";
    throw InputError(what.str());
  };
  for (const MediumInterval& i : medium.interval)
    for (int c = 0; c < medium_columns; ++c)
      for (double x : i.c[std::size_t(c)])
        if (!std::isfinite(x)) refuse(i.v0, Terms{Terms::bit(static_cast<Term>(c / 3))}.text());
  for (const Dirac& d : medium.dirac)
    for (std::size_t ch = 0; ch < 3; ++ch)
      if (!std::isfinite(d.mu[ch]) || !std::isfinite(d.c[ch]) || !std::isfinite(d.v)) refuse(d.v, "Dirac term");
}

// The columns that are not 0 everywhere: most media use few of the 24.
std::vector<std::size_t> used_columns(const Medium& medium) {
  std::vector<std::size_t> used;
  const Terms terms = medium.terms();
  for (int c = 0; c < medium_columns; ++c)
    if (terms.has(static_cast<Term>(c / 3))) used.push_back(std::size_t(c));
  return used;
}

// Visits the parts of [a, b] on which every column is one polynomial: visit(interval, ta, tb, part's width).
// `first` is the interval that holds a, or the outermost one; it advances with a.
template <class Visit>
void for_parts(const Medium& medium, std::size_t& first, double a, double b, const Visit& visit) {
  const auto& all = medium.interval;
  while (first + 1 < all.size() && a >= all[first].v1) ++first;
  double from = a;
  for (std::size_t k = first; from < b; ++k) {
    const MediumInterval& i = all[k];
    const auto t = [&](double v) { return std::clamp((v - i.v0) / (i.v1 - i.v0), 0.0, 1.0); };
    if (from < i.v0) {  // below the first interval: constant
      const double to = std::min(b, i.v0);
      visit(i, 0.0, 0.0, to - from);
      from = to;
    }
    const double to = std::min(b, i.v1);
    if (to > from) {
      visit(i, t(from), t(to), to - from);
      from = to;
    }
    if (k + 1 == all.size()) {
      if (from < b) visit(i, 1.0, 1.0, b - from);  // above the last interval: constant
      return;
    }
  }
}

int cell_of(const CellGrid& grid, double v) {
  int k = std::clamp(static_cast<int>((v - grid.v_min) / grid.width()), 0, grid.cells() - 1);
  while (k > 0 && v <= grid.value(k)) --k;
  while (k + 1 < grid.cells() && v > grid.value(k + 1)) ++k;
  return k;
}
}  // namespace

Cells integrate_cells(const Medium& medium, const CellGrid& grid) {
  check(medium, grid);
  Cells r;
  r.grid = grid;
  const std::size_t cells = std::size_t(grid.cells());
  for (std::size_t c = 0; c < medium_columns; ++c) {
    r.integral[c].assign(cells, 0.0);
    if (!is_surface(int(c))) r.at_value[c].assign(cells + 1, 0.0);
  }
  const auto used = used_columns(medium);
  std::size_t first = 0, at = 0;
  if (!medium.interval.empty()) {
    for (int k = 0; k < grid.cells(); ++k) {
      const double a = grid.value(k), b = grid.value(k + 1);
      for_parts(medium, first, a, b, [&](const MediumInterval& i, double ta, double tb, double width) {
        for (std::size_t c : used)
          r.integral[c][std::size_t(k)] += mean(i.c[c], ta, tb) * (is_surface(int(c)) ? width : width / (b - a));
      });
    }
    for (int i = 0; i < grid.n; ++i) {
      const double v = grid.value(i);
      while (at + 1 < medium.interval.size() && v >= medium.interval[at].v1) ++at;
      const MediumInterval& here = medium.interval[at];
      const double t = std::clamp((v - here.v0) / (here.v1 - here.v0), 0.0, 1.0);
      for (std::size_t c : used)
        if (!is_surface(int(c))) r.at_value[c][std::size_t(i)] = polynomial(here.c[c], t);
    }
  }
  for (const Dirac& d : medium.dirac) {
    if (!(d.v > grid.v_min && d.v <= grid.v_max)) continue;  // no segment of the grid crosses it
    const int k = cell_of(grid, d.v);
    const double a = grid.value(k), b = grid.value(k + 1);
    r.dirac.push_back({k, std::clamp((d.v - a) / (b - a), 0.0, 1.0), d.mu, d.c});
  }
  std::stable_sort(r.dirac.begin(), r.dirac.end(), [](const CellDirac& a, const CellDirac& b) {
    return a.cell < b.cell || (a.cell == b.cell && a.u < b.u);
  });
  return r;
}

std::optional<std::pair<int, int>> changed_cells(const Cells& a, const Cells& b) {
  if (a.grid != b.grid) throw InputError("pre-integration table: cells of different grids cannot be compared");
  const int cells = a.grid.cells();
  std::vector<char> changed(std::size_t(cells), 0);
  for (std::size_t c = 0; c < medium_columns; ++c) {
    for (std::size_t k = 0; k < std::size_t(cells); ++k)
      if (a.integral[c][k] != b.integral[c][k]) changed[k] = 1;
    for (std::size_t i = 0; i < a.at_value[c].size(); ++i)
      if (a.at_value[c][i] != b.at_value[c][i])
        for (std::size_t k : {i == 0 ? 0 : i - 1, std::min(i, std::size_t(cells) - 1)}) changed[k] = 1;
  }
  const auto mark = [&](const std::vector<CellDirac>& from, const std::vector<CellDirac>& in) {
    for (const CellDirac& d : from)
      if (std::find(in.begin(), in.end(), d) == in.end()) changed[std::size_t(d.cell)] = 1;
  };
  mark(a.dirac, b.dirac);
  mark(b.dirac, a.dirac);
  const auto first = std::find(changed.begin(), changed.end(), 1);
  if (first == changed.end()) return std::nullopt;
  const auto last = std::find(changed.rbegin(), changed.rend(), 1);
  return std::pair(int(first - changed.begin()), int(cells - (last - changed.rbegin())));
}

}  // namespace dvrlab::preintegrated
