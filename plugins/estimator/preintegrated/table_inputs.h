// The cells of a medium as the builder's modules read them: summed per source column, padded, in both directions.
#pragma once

#include <array>
#include <vector>

#include "plugins/estimator/preintegrated/cells.h"
#include "plugins/estimator/preintegrated/table_module.h"
#include "plugins/estimator/preintegrated/table_request.h"

namespace dvrlab::preintegrated {

class TableInputs {
 public:
  /// `h`: nominal length of a segment, in world units.
  TableInputs(const Cells& cells, const TableRequest& request, double h);
  TableInputs(const TableInputs&) = delete;
  TableInputs& operator=(const TableInputs&) = delete;
  /// Refers to this object's memory. The caller sets `out` and `stream`.
  const dvr_table_job& job() const { return job_; }

 private:
  /// An array with DVR_TABLE_PAD elements before and behind it, which outlives the job.
  double* padded(std::size_t count);
  /// Prefix sums of `values`, n entries; null when all are 0.
  dvr_table_prefix prefix(const std::vector<double>& values);
  double* copy(const std::vector<double>& values, bool mirrored);
  void add_diracs(const Cells& cells, const TableRequest& request);
  void add_side(int direction, const Cells& cells, const TableRequest& request);

  dvr_table_job job_{};
  std::vector<std::vector<double>> memory_;
  std::vector<std::int32_t> dirac_first_, dirac_at_;
  std::array<std::vector<std::int32_t>, 2> dirac_cell_;
  std::array<std::vector<std::uint8_t>, 2> dirac_near_;
};

}  // namespace dvrlab::preintegrated
