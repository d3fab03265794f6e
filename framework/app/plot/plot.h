// `dvrlab info --plot`: the logarithmic histogram of data, with transfer functions below it.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "framework/app/plot/tf_bars.h"
#include "framework/scene/histogram.h"

namespace dvrlab {

/// The transfer functions of one optical model.
struct PlotModel {
  std::string title;  // "" when there is one model only
  std::vector<TfBar> bars;
};

struct Plot {
  std::string title;
  double lo = 0, hi = 1;               // values along x, in the unit of the transfer functions
  std::optional<Histogram> histogram;  // of physical values; none for a formula
  double slope = 1, intercept = 0;     // value along x = slope * physical value + intercept
  std::vector<PlotModel> models;
};

/// Throws InputError when the name does not end in .svg or .png.
void check_plot_name(const std::string& file);

/// Draws into an .svg or .png file, which appears complete or not at all. Throws what check_plot_name throws, or
/// std::runtime_error naming the file.
void write_plot(const std::string& file, const Plot& plot);

}  // namespace dvrlab
