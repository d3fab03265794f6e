// out/<experiment>/{cases/<id>/{case.json,image.exr,image.png}, results.csv, views.csv}: the only contract between a
// run and whatever reads its results. Every file appears complete or not at all.
#pragma once

#include <string>
#include <vector>

#include "framework/report/case_record.h"

namespace dvrlab {

class ResultsTree {
 public:
  /// Makes <out>/<experiment>/cases. Throws std::runtime_error when that is not possible.
  ResultsTree(const std::string& out, const std::string& experiment);

  const std::string& folder() const { return folder_; }
  std::string case_folder(const std::string& id) const { return folder_ + "/cases/" + id; }

  void write_images(const CaseRecord& record, const FrameImage& image) const;
  /// The config's base_folder becomes relative to the case's folder where both lie in one folder other than "/": that
  /// folder can be moved, and its cases still run again. A case that has no image loses those of an earlier run.
  void write_case(const CaseRecord& record) const;
  /// One row per case; columns: id, role, axes, backend, verdict, counters, times, metrics.
  void write_table(const std::vector<CaseRecord>& records) const;
  /// views.csv: mean and worst of every metric over the views of an orbit; nothing where there are no views.
  void write_views(const std::vector<CaseRecord>& records) const;

 private:
  std::string folder_;
};

}  // namespace dvrlab
