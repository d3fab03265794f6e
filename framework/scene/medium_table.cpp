#include "framework/scene/medium_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/scene/buffers.h"

namespace dvrlab {

namespace {

using Columns = std::array<double, medium_columns>;

double col(const Columns& x, Term t, int c) { return x[std::size_t(column(t, c))]; }

Buffer table_of(const Medium& m, const MediumTableOptions& o, const MediumLayout& layout) {
  std::vector<std::vector<MediumGroup>> entry;
  for (int e = 0; e < o.entries; ++e) entry.push_back(layout.groups(m.at(o.lo + (o.hi - o.lo) * e / (o.entries - 1))));
  std::vector<float> r;
  std::vector<double> r64;
  for (std::size_t e = 0; e < entry.size(); ++e) {
    const auto& next = entry[std::min(e + 1, entry.size() - 1)];
    for (std::size_t g = 0; g < entry[e].size(); ++g) {
      for (double x : entry[e][g]) r.push_back(float(x));
      for (std::size_t k = 0; k < 4; ++k) r.push_back(float(next[g][k]) - float(entry[e][g][k]));
      r64.insert(r64.end(), entry[e][g].begin(), entry[e][g].end());
      for (std::size_t k = 0; k < 4; ++k) r64.push_back(next[g][k] - entry[e][g][k]);
    }
  }
  return vec4_buffer("medium_table", std::move(r), std::move(r64));
}

void add_nodes(const Medium& m, const MediumLayout& layout, KernelUnit& unit) {
  std::size_t padded = 1;
  while (padded < m.interval.size()) padded *= 2;
  std::vector<double> node, poly;
  constexpr double beyond = std::numeric_limits<float>::max();
  for (std::size_t k = 0; k < m.interval.size(); ++k) {
    const MediumInterval& i = m.interval[k];
    node.insert(node.end(),
                {i.v0, 1.0 / (i.v1 - i.v0), k + 1 < m.interval.size() ? m.interval[k + 1].v0 : beyond, 0.0});
    std::array<std::vector<MediumGroup>, 3> power;
    for (std::size_t p = 0; p < 3; ++p) {
      Columns x;
      for (std::size_t c = 0; c < medium_columns; ++c) x[c] = i.c[c][p];
      power[p] = layout.groups(x);
    }
    for (std::size_t g = 0; g < power[0].size(); ++g)
      for (const auto& p : power) poly.insert(poly.end(), p[g].begin(), p[g].end());
  }
  // The search compares with v0 only: the first interval reaches to the left of every value, padding is out of reach
  // (the outer intervals are constant, so their coordinate does not matter).
  node[0] = std::numeric_limits<float>::lowest();
  node[1] = 0.0;
  for (std::size_t k = m.interval.size(); k < padded; ++k) node.insert(node.end(), {beyond, 0.0, beyond, 0.0});
  unit.uniforms.push_back(Uniform::constant_integer("medium_node_step", int(padded / 2)));
  unit.buffers.push_back(vec4_buffer("medium_node", std::move(node)));
  unit.buffers.push_back(vec4_buffer("medium_node_poly", std::move(poly)));
}

// Bin b covers [edge(b), edge(b+1)], the outermost bins everything beyond.
template <class Test>
std::vector<int> prefix_sums(const MediumTableOptions& o, Test contributes) {
  std::vector<int> sum{0};
  const double inf = std::numeric_limits<double>::infinity();
  for (int b = 0; b + 1 < o.entries; ++b) {
    const double a = b == 0 ? -inf : o.lo + (o.hi - o.lo) * b / (o.entries - 1);
    const double c = b + 2 == o.entries ? inf : o.lo + (o.hi - o.lo) * (b + 1) / (o.entries - 1);
    sum.push_back(sum.back() + (contributes(a, c) ? 1 : 0));
  }
  sum.push_back(sum.back());  // the kernel may ask one bin beyond the last
  sum.push_back(sum.back());
  return sum;
}

}  // namespace

namespace {
/// True where the highlight's weight is the extinction, as polynomials of every interval.
bool weighs_extinction(const Medium& medium, Term weight, Term extinction) {
  return std::all_of(medium.interval.begin(), medium.interval.end(), [&](const MediumInterval& i) {
    for (int c = 0; c < 3; ++c)
      if (i.c[std::size_t(column(weight, c))] != i.c[std::size_t(column(extinction, c))]) return false;
    return true;
  });
}

MediumLayout::Form form_of(const Medium& medium, const MediumTableOptions& o) {
  using enum MediumLayout::Form;
  const Terms terms = medium.terms();
  if (!o.full || o.rgb || (o.lit_particles && terms.has(Term::E))) return general;
  if (terms.surfaces() && !weighs_extinction(medium, Term::W_s, Term::tau_s)) return general;
  if (!terms.has(Term::S_l) && !terms.has(Term::W_l)) return compact_unlit;
  const bool mixed = terms.has(Term::E) || terms.has(Term::P) || !weighs_extinction(medium, Term::W_l, Term::tau_l);
  return mixed ? general : compact_lit;
}
}  // namespace

MediumLayout::MediumLayout(const Medium& medium, const MediumTableOptions& options)
    : options_(options), form_(form_of(medium, options)) {
  const Terms terms = medium.terms();
  emits_ = options.full && (terms.has(Term::E) || terms.has(Term::P));
  surfaces_ = options.full && terms.surfaces();
  if (form_ != Form::general)
    count_ = surfaces_ ? 2 : 1;
  else if (options.full)
    count_ = 3 + (emits_ ? 2 : 0) + (surfaces_ ? 2 : 0);
  else
    count_ = options.rgb ? 2 : 1;
}

std::vector<MediumGroup> MediumLayout::groups(const Columns& x) const {
  std::vector<MediumGroup> g(static_cast<std::size_t>(count_));
  write(x, g.front().data());
  return g;
}

int MediumLayout::extinction_at(int channel) const {
  if (form_ != Form::general) return 3;
  return options_.full || options_.rgb ? channel : 0;
}

void MediumLayout::write(const Columns& x, double* to) const {
  const auto rgb = [&](Term t, double w) {
    for (int c = 0; c < 3; ++c) *to++ = col(x, t, c);
    *to++ = w;
  };
  if (form_ != Form::general) {
    if (form_ == Form::compact_unlit) {
      for (int c = 0; c < 3; ++c) *to++ = col(x, Term::E, c) + col(x, Term::P, c);
      *to++ = col(x, Term::tau_l, 0);
    } else {
      rgb(Term::S_l, col(x, Term::tau_l, 0));
    }
    if (surfaces_) rgb(Term::S_s, col(x, Term::tau_s, 0));
    return;
  }
  if (options_.full) {
    rgb(Term::tau_l, col(x, Term::tau_s, 0));
    rgb(Term::S_l, col(x, Term::tau_s, 1));
    rgb(Term::W_l, col(x, Term::tau_s, 2));
    if (emits_) {
      rgb(Term::E, 0);
      rgb(Term::P, 0);
    }
    if (surfaces_) {
      rgb(Term::S_s, 0);
      rgb(Term::W_s, 0);
    }
    return;
  }
  if (options_.rgb)
    rgb(Term::tau_l, 0);
  else
    *to++ = col(x, Term::tau_l, 0);
  for (int c = 0; c < 3; ++c)
    *to++ = col(x, Term::E, c) + col(x, Term::P, c) + (options_.fold_shaded ? col(x, Term::S_l, c) : 0.0);
  if (options_.rgb) *to++ = 0;
}

int fetches_of_point(const Medium& medium, const MediumTableOptions& o) {
  const int groups = MediumLayout(medium, o).count();
  // A table: value and difference. Nodes: a binary search, the interval, and three coefficients.
  return o.nodes ? std::bit_width(std::bit_ceil(medium.interval.size())) + 3 * groups : 2 * groups;
}

void add_medium(const Medium& medium, const MediumTableOptions& o, KernelUnit& unit) {
  const MediumLayout layout(medium, o);
  unit.uniforms.insert(
      unit.uniforms.end(),
      {Uniform::constant_integer("medium_use_nodes", o.nodes ? 1 : 0),
       Uniform::constant_integer("medium_groups", layout.count()),
       Uniform::constant_integer("medium_form", int(layout.form())),
       Uniform::constant_integer("medium_lit_particles", o.full && o.lit_particles ? 1 : 0),
       Uniform::constant_integer("medium_emits", layout.emits() ? 1 : 0),
       Uniform::constant_integer("medium_surfaces", layout.surfaces() ? 1 : 0), Uniform::real("medium_lo", o.lo),
       Uniform::real("medium_scale", (o.entries - 1) / (o.hi - o.lo)), Uniform::real("medium_last", o.entries - 1)});
  // The representation that is not in use keeps its binding with one empty entry.
  if (o.nodes) {
    unit.buffers.push_back(vec4_buffer("medium_table", {}));
    add_nodes(medium, layout, unit);
  } else {
    unit.buffers.push_back(table_of(medium, o, layout));
    unit.uniforms.push_back(Uniform::constant_integer("medium_node_step", 0));
    unit.buffers.push_back(vec4_buffer("medium_node", {}));
    unit.buffers.push_back(vec4_buffer("medium_node_poly", {}));
  }
  std::vector<int> sum = prefix_sums(o, [&](double a, double b) { return !medium.unshaded(a, b); });
  const std::uint64_t count = sum.size();
  unit.buffers.push_back(make_buffer("medium_shaded_sum", Element::i32, std::move(sum), count));
}

OccupiedBins::OccupiedBins(const Medium& medium, MediumTableOptions o, int cells) {
  if (cells > 0) o.entries = std::min(o.entries, cells + 1);
  lo_ = o.lo;
  scale_ = (o.entries - 1) / (o.hi - o.lo);
  sum_ = prefix_sums(o, [&](double a, double b) { return !medium.empty(a, b); });
}

bool OccupiedBins::empty(double a, double b) const {
  const double bins = double(sum_.size()) - 3.0;
  const auto bin = [&](double v, double margin) {
    return std::clamp(std::floor((v - lo_) * scale_) + margin, 0.0, bins - 1.0);
  };
  return sum_[std::size_t(bin(b, 1.0)) + 1] == sum_[std::size_t(bin(a, -1.0))];
}

}  // namespace dvrlab
