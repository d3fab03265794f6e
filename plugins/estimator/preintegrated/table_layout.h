// Where the entries of a table lie in memory (docs/math, section B.5, look-up).
//
// Every direction and every group of 4 channels is a block of its own; all lie one after the other in one buffer, whose
// pages a GPU binds.
// Directions: `ascending` holds the entries (i, j), i <= j, `descending` those with i >= j. A row holds all entries of
// one front value, at m = |j - i| = 0, 1, ... one after the other; so the table is skewed: neighbours across the
// diagonal never mix. The row of a descending entry counts from the upper end: a descending segment is looked up
// exactly as an ascending one in the mirrored coordinate x' = (n - 1) - x.
// The shortest row comes first, and rows are padded to 4 entries (a cache line of 64 bytes) with zeros.
#pragma once

#include <cstdint>

namespace dvrlab::preintegrated {

enum class Direction { ascending, descending };

/// Entries of the rows of length 1 .. k, padding included: the sum over j = 1 .. k of 4 ceil(j / 4). Only shifts and
/// whole numbers, so that a kernel can compute it; fits in 31 bits up to n = 65000.
constexpr std::int64_t padded_triangle(std::int64_t k) {
  const std::int64_t a = k >> 2, b = k & 3;
  return 4 * (a + 1) * (2 * a + b);
}

/// Entries of one buffer for n values.
constexpr std::int64_t table_entries(int n) { return padded_triangle(n); }

/// The row of the front value i.
constexpr int table_row(Direction d, int n, int i) { return d == Direction::ascending ? i : n - 1 - i; }

/// The first entry (m = 0) of a row; row r has n - r entries.
constexpr std::int64_t row_start(int n, int row) { return padded_triangle(n - 1 - row); }

/// The entry of a segment from grid value i to grid value j; i == j lies in both directions.
constexpr std::int64_t table_entry(Direction d, int n, int i, int j) {
  return row_start(n, table_row(d, n, i)) + (j > i ? j - i : i - j);
}

}  // namespace dvrlab::preintegrated
