// Which values of unknown data are background, soft and dense.
#pragma once

#include "framework/scene/histogram.h"

namespace dvrlab {

/// Physical values. Below `cut` lies the background; from `dense` on the material is dense; `top` is where values begin
/// to be rare.
struct ValueClasses {
  double cut = 0, dense = 0, top = 0;
};

/// Otsu's method with two thresholds: three classes of values, as far apart as possible. N. Otsu, A Threshold Selection
/// Method from Gray-Level Histograms, IEEE Trans. SMC 9(1), 1979, doi:10.1109/TSMC.1979.4310076.
/// cut < dense <= top, except where all values are the same.
ValueClasses value_classes(const Histogram& histogram);

}  // namespace dvrlab
