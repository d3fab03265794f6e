// What `dvrlab info --plot` draws of data or of a config.
#pragma once

#include <memory>

#include "framework/app/info_report.h"
#include "framework/app/plot/plot.h"
#include "framework/config/experiment.h"

namespace dvrlab {

/// The data's histogram, and the transfer functions of every optical model of the experiment that reads this data;
/// `experiment` may be null. Throws InputError when the models do not share one unit of values.
Plot plot_of(const InfoReport& info, const Experiment* experiment);

}  // namespace dvrlab
