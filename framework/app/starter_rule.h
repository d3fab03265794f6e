// How a first picture is chosen from the data alone: which values to show, and from where.
#pragma once

#include "framework/interfaces/field.h"
#include "framework/scene/histogram.h"

namespace dvrlab {

/// Physical values. Below `cut` lies the background; from `dense` on the material is dense; `top` is where bright
/// begins to be rare.
struct ValueClasses {
  double cut = 0, dense = 0, top = 0;
};

/// Otsu's method with two thresholds: three classes of values, as far apart as possible.
/// N. Otsu, A Threshold Selection Method from Gray-Level Histograms, IEEE Trans. SMC 9(1), 1979,
/// doi:10.1109/TSMC.1979.4310076.
ValueClasses value_classes(const Histogram& histogram);

/// In the frame "data": origin at the centre of the data's box, unit = half its diagonal.
struct StarterView {
  Vector3 position{}, target{};
  double fov_deg = 30;
  Vector3 towards_light{};
  double diagonal = 0;  // of what is visible, world units
};

/// A view that holds every voxel of at least `cut`: from the left and above, in front of a patient; where no anatomy is
/// known the same against the world's axes.
StarterView starter_view(const GridField& grid, double cut);

}  // namespace dvrlab
