// Full two-dimensional pre-integration tables (docs/math, B.5): the integral of every segment between two grid
// values, by the contractive form of incremental subrange integration (Lum, Wilson, Ma 2004, corrected), in fp64, over
// all processors with SIMD. table_layout.h has the order of the entries.
#pragma once

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "plugins/estimator/preintegrated/cells.h"
#include "plugins/estimator/preintegrated/table_layout.h"
#include "plugins/estimator/preintegrated/table_request.h"

namespace dvrlab::preintegrated {

/// Where and how a table is computed; none of it changes a bit of the result.
struct BuildMeans {
  std::string folder;        // of the modules table.<isa>.so
  std::string isa = "auto";  // "scalar", "sse4.2", "avx2", "avx512", or the widest there is
  int threads = 0;           // 0: all that this process may use
};

class Table {
 public:
  /// Computes everything. `h` is the nominal length of a segment (world units), > 0 and finite; n <= 65000. Throws
  /// InputError.
  Table(Cells cells, TableRequest request, double h, const BuildMeans& means);

  /// Another table with the same entries.
  Table copy() const;
  /// The table of `cells` on the same grid: recomputes the entries that pass a changed cell. Their neighbours in a
  /// block of diagonals may be recomputed too; recomputed entries can differ from those of a new table in the last bit
  /// of a float. Returns false when nothing had changed. Buffers handed out before see the change.
  bool update(Cells cells, const BuildMeans& means);

  /// 4 floats per entry, table_entries(n) entries; group g has the request's outputs 4g .. 4g+3.
  const float* buffer(Direction direction, int group) const;
  /// All buffers, one after the other: the groups of the ascending direction, then those of the descending one.
  std::shared_ptr<const float> memory() const { return memory_; }
  /// One channel of the entry from grid value i to grid value j (i == j: of the ascending direction).
  float at(int i, int j, int output) const;
  /// Overwrites it.
  void set(int i, int j, int output, float x);

  int values() const { return cells_.grid.n; }
  double h() const { return h_; }
  const Cells& cells() const { return cells_; }
  const TableRequest& request() const { return request_; }
  /// Of all buffers. A build works with about 1 MiB more per thread and 1000 values.
  static std::uint64_t bytes(int n, const TableRequest& request);

 private:
  std::int64_t place(int i, int j, int output) const;
  void compute(int first, int last, const BuildMeans& means);

  Cells cells_;
  TableRequest request_;
  double h_;
  std::shared_ptr<float> memory_;  // [direction][group][entry]
};

}  // namespace dvrlab::preintegrated
