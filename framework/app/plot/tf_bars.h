// The transfer functions of an optical model as they are drawn: pairs of an amount and a colour, and isosurfaces.
#pragma once

#include <string>
#include <vector>

#include "framework/config/resolved_case.h"

namespace dvrlab {

/// A discrete isosurface: a spike.
struct TfSpike {
  double value, opacity;
  Vector3 color;
};

/// A pair as a bar: the amount (opacity, density, intensity, extinction) is its alpha, the colour its colour.
struct TfBar {
  std::string title;  // the keys: "surface.opacity, surface.color"
  Nodes amount, color;
  double top = 1;  // the amount that is drawn at full height: 1, or the largest where it exceeds 1
  std::vector<TfSpike> spikes;
};

/// `amount` and `color` at a value: linear between the nodes, constant outside, the right limit at a jump; without
/// nodes 0 and white.
Vector3 amount_at(const TfBar& bar, double value);
Vector3 color_at(const TfBar& bar, double value);

/// One bar per amount that is given, in the order of the model's declaration, whatever the model: of the declared
/// nodes, those whose name ends in "color" are the colour of their group or, outside groups, of whatever has none; the
/// others are amounts.
std::vector<TfBar> tf_bars(const ParameterSet& model);

}  // namespace dvrlab
