// Mean and worst over the views of an orbit: what one number says of cases that differ in their view only.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/report/case_record.h"

namespace dvrlab {

/// One value of a metric over some views. A metric's perfect infinity (psnr of equal images) does not enter the mean,
/// which is that of the other views; it is infinite only when all are. The other infinity makes the mean infinite, and
/// a NaN makes mean and worst NaN.
struct ViewStatistic {
  double mean = 0, worst = 0;
  std::size_t worst_at = 0;  // index of the first worst value
  std::size_t perfect = 0;   // values left out of the mean
};

/// `values` is not empty. `higher`: the larger of two values is the better one.
ViewStatistic view_statistic(const std::vector<double>& values, bool higher);

/// One row of views.csv.
struct ViewRow {
  std::vector<AxisChoice> choices;  // of all views alike: every axis but camera.view
  std::string against, metric;      // "psnr", "psnr.r"
  ViewStatistic statistic;
  std::string worst_view;
  std::size_t views = 0;    // that have the value
  std::size_t planned = 0;  // all of them
  bool headline = false;    // the first value of its metric
};

/// A row per group of views and value of a metric, in running order. Cases without views have none, and places in
/// the image (max_abs.x, max_abs.y) have no mean.
std::vector<ViewRow> view_rows(const std::vector<CaseRecord>& records);

/// "estimator=direct,backend=cpu,": what the case chose on all axes but that of `key`, zipped keys included; where
/// `key` is no axis, but those of the sections that it lies in. Equal for cases that differ in `key` only.
std::string group_without(const PlannedCase& c, const std::string& key);

}  // namespace dvrlab
