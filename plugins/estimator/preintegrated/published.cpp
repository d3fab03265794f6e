#include "plugins/estimator/preintegrated/published.h"

#include <array>
#include <atomic>
#include <thread>
#include <utility>
#include <vector>

#include "backends/cpu/isa.h"
#include "plugins/estimator/preintegrated/definition.h"

namespace dvrlab::preintegrated {
namespace {

using Kind = OutputChannel::Kind;

/// All entries of m cells in one direction, in the order of their front values along it.
std::vector<Entry> entries_of(const Table& t, Variant variant, const SourceColumn& source, int extinction, int m,
                              bool descending) {
  if (variant == Variant::published_slide) return published_slide(t.cells(), source, extinction, t.h(), m, descending);
  const int n = t.values();
  std::vector<Entry> entries;
  for (int i = 0; i + m < n; ++i) {
    const int front = descending ? n - 1 - i : i, end = descending ? front - m : front + m;
    entries.push_back(defined_entry(t.cells(), source, extinction, t.h(), front, end, descending ? -1 : 1));
  }
  return entries;
}

/// What an output is computed from; a column's total and its back part share it.
struct From {
  SourceColumn source;
  int extinction;
  bool operator==(const From&) const = default;
};

From from_of(const TableRequest& r, const OutputChannel& o) {
  if (o.kind == Kind::transmittance) return {{}, r.rgb_extinction ? o.index : 0};
  const SourceColumn source = r.columns[std::size_t(o.index)];
  return {source, r.rgb_extinction ? source.channel : 0};
}

void fill_diagonals(Table& t, Variant variant, int m) {
  const TableRequest& r = t.request();
  const int n = t.values();
  std::vector<std::pair<From, std::array<std::vector<Entry>, 2>>> known;  // ascending, descending
  const auto entries_from = [&](const From& from) -> const std::array<std::vector<Entry>, 2>& {
    for (const auto& [other, entries] : known)
      if (other == from) return entries;
    return known
        .emplace_back(from, std::array{entries_of(t, variant, from.source, from.extinction, m, false),
                                       entries_of(t, variant, from.source, from.extinction, m, true)})
        .second;
  };
  for (int o = 0; o < static_cast<int>(r.outputs.size()); ++o) {
    const OutputChannel output = r.outputs[std::size_t(o)];
    if (output.kind == Kind::zero) continue;
    const auto& entries = entries_from(from_of(r, output));
    for (int i = 0; i + m < n; ++i) {
      const auto value = [&](const Entry& e) {
        return static_cast<float>(output.kind == Kind::transmittance ? e.T : output.kind == Kind::back ? e.B : e.C);
      };
      t.set(i, i + m, o, value(entries[0][std::size_t(i)]));
      t.set(n - 1 - i, n - 1 - i - m, o, value(entries[1][std::size_t(i)]));
    }
  }
}

}  // namespace

std::shared_ptr<const Table> published_table(const Table& table, Variant variant, int threads) {
  auto t = std::make_shared<Table>(table.copy());
  std::atomic<int> next = 1;
  const auto work = [&] {
    for (int m = next++; m < t->values(); m = next++) fill_diagonals(*t, variant, m);
  };
  std::vector<std::jthread> helpers;
  for (int k = 1; k < cpu::thread_count(threads); ++k) helpers.emplace_back(work);
  work();
  helpers.clear();
  return t;
}

}  // namespace dvrlab::preintegrated
