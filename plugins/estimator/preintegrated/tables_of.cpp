#include "plugins/estimator/preintegrated/tables_of.h"

#include <algorithm>
#include <list>
#include <mutex>
#include <span>

namespace dvrlab::preintegrated {
namespace {

using Kind = OutputChannel::Kind;

/// Appends source columns and groups of outputs.
class RequestWriter {
 public:
  explicit RequestWriter(TableRequest& request) : r_(request) {}

  /// Three columns with the terms that `set` sets, one per colour channel; returns the first one's index.
  template <class Set>
  int columns(Set set) {
    const int first = static_cast<int>(r_.columns.size());
    for (int channel = 0; channel < 3; ++channel) {
      SourceColumn c;
      set(c);
      c.channel = channel;
      r_.columns.push_back(c);
    }
    return first;
  }
  int group(std::initializer_list<OutputChannel> outputs) {
    r_.outputs.insert(r_.outputs.end(), outputs);
    return static_cast<int>(r_.outputs.size()) / 4 - 1;
  }
  static OutputChannel total(int column) { return {Kind::total, column}; }
  static OutputChannel back(int column) { return {Kind::back, column}; }
  /// Groups of the columns a, b, c, d (-1: none), weighted with the powers 1 .. degree of w.
  void weighted_groups(int a, int b, int c, int d, int degree) {
    constexpr Kind kinds[] = {Kind::back, Kind::second, Kind::third};
    for (Kind kind : std::span(kinds, static_cast<std::size_t>(degree))) {
      const auto output = [&](int column) { return column < 0 ? OutputChannel{} : OutputChannel{kind, column}; };
      group({output(a), output(b), output(c), output(d)});
    }
  }

 private:
  TableRequest& r_;
};

}  // namespace

TableRequest request_of(const Terms& terms, bool full, bool lit_particles, bool plain, int degree, Groups& groups) {
  TableRequest request;
  request.rgb_extinction = terms.rgb();
  request.ratio = !plain;
  RequestWriter write(request);
  const auto total = RequestWriter::total;
  const auto back = RequestWriter::back;
  const OutputChannel none{};
  const auto through = [&](int channel) { return plain ? OutputChannel{Kind::transmittance, channel} : none; };
  if (!full) {
    const int c = write.columns([](SourceColumn& s) { s.E = s.P = s.S = true; });
    groups.emitted = write.group({total(c), total(c + 1), total(c + 2), through(0)});
  } else {
    const int s = write.columns([](SourceColumn& x) { x.S = true; });
    const int w = static_cast<int>(request.columns.size());
    for (int channel = 0; channel < request.extinctions(); ++channel) {
      SourceColumn highlight;
      highlight.W = true;
      highlight.channel = channel;
      request.columns.push_back(highlight);
    }
    groups.shaded = write.group({total(s), total(s + 1), total(s + 2), total(w)});
    write.weighted_groups(s, s + 1, s + 2, w, degree);
    if (terms.has(Term::E) || (terms.has(Term::P) && !lit_particles) || plain) {
      const int e = write.columns([&](SourceColumn& x) {
        x.E = true;
        x.P = !lit_particles;
      });
      groups.emitted = write.group({total(e), total(e + 1), total(e + 2), through(0)});
    }
    if (terms.has(Term::P) && lit_particles) {
      const int p = write.columns([](SourceColumn& x) { x.P = true; });
      groups.particles = write.group({total(p), total(p + 1), total(p + 2), none});
      write.weighted_groups(p, p + 1, p + 2, -1, degree);
    }
    if (request.rgb_extinction) {
      groups.highlight = degree > 0 ? write.group({total(w + 1), total(w + 2), back(w + 1), back(w + 2)})
                                    : write.group({total(w + 1), total(w + 2), none, none});
      if (degree > 1)
        write.group({{Kind::second, w + 1}, {Kind::second, w + 2}, {Kind::third, w + 1}, {Kind::third, w + 2}});
    }
  }
  if (plain && request.rgb_extinction) groups.through = write.group({through(0), through(1), through(2), none});
  return request;
}

std::shared_ptr<const Table> table_of(const Medium& medium, double lo, double hi, int n, const TableRequest& request,
                                      double h, bool partial, const BuildMeans& means) {
  static std::mutex mutex;
  struct Built {
    std::shared_ptr<const Table> table;
    bool updated;  // in part: not the bits of a new one
  };
  static std::list<Built> built;  // the newest first
  constexpr std::size_t kept = 2;
  Cells cells = integrate_cells(medium, {n, lo, hi});
  const std::lock_guard lock(mutex);
  const auto fits = [&](const Table& t) {
    return t.request() == request && t.h() == h && t.cells().grid == cells.grid;
  };
  for (const Built& b : built)
    if (fits(*b.table) && (partial || !b.updated) && !changed_cells(b.table->cells(), cells)) return b.table;
  while (built.size() >= kept) built.pop_back();  // room for the new one
  const auto too_large = [](const Built& b) {
    return Table::bytes(b.table->cells().grid.n, b.table->request()) > most_bytes_kept;
  };
  if (!partial) built.remove_if(too_large);
  std::shared_ptr<const Table> table;
  bool updated = false;
  for (const Built& b : built) {
    if (!partial || updated || !fits(*b.table)) continue;
    auto copy = std::make_shared<Table>(b.table->copy());
    copy->update(cells, means);
    table = copy;
    updated = true;
  }
  if (table == nullptr) table = std::make_shared<Table>(std::move(cells), request, h, means);
  built.push_front({table, updated});
  return table;
}

}  // namespace dvrlab::preintegrated
