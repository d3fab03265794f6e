#include "plugins/estimator/preintegrated/published.h"

#include <atomic>
#include <thread>

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

void fill_diagonals(Table& t, Variant variant, int m) {
  const TableRequest& r = t.request();
  const int n = t.values();
  for (int o = 0; o < static_cast<int>(r.outputs.size()); ++o) {
    const OutputChannel output = r.outputs[std::size_t(o)];
    if (output.kind == Kind::zero) continue;
    const bool through = output.kind == Kind::transmittance;
    const SourceColumn source = through ? SourceColumn{} : r.columns[std::size_t(output.index)];
    const int extinction = !r.rgb_extinction ? 0 : through ? output.index : source.channel;
    for (const bool descending : {false, true}) {
      const std::vector<Entry> entries = entries_of(t, variant, source, extinction, m, descending);
      for (int i = 0; i + m < n; ++i) {
        const Entry& e = entries[std::size_t(i)];
        const double x = through ? e.T : output.kind == Kind::back ? e.B : e.C;
        const int front = descending ? n - 1 - i : i;
        t.set(front, descending ? front - m : front + m, o, static_cast<float>(x));
      }
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
