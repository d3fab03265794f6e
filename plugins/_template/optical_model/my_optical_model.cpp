// The `my_optical_model` optical model: one colour whose extinction rises linearly over a window of values.
#include <algorithm>

#include "framework/interfaces/error.h"
#include "framework/interfaces/transfer_function.h"

namespace dvrlab::my_optical_model {
namespace {

using enum ParameterType;

const Parameter parameters[] = {
    {"lower", number, "value", "0.4", "", "Below this value there is nothing.", Affects::pixels, "", "0.2"},
    {"upper", number, "value", "0.6", "", "From this value on the extinction is full.", Affects::pixels, "", "0.9"},
    {"extinction", number, "1/length_unit", "0.5", "[0,inf)", "Extinction above the window.", Affects::pixels, "", "2"},
    {"color", vector3, "", "[1,0.8,0.5]", "[0,inf)", "Colour of the particles.", Affects::pixels, "", "[0.2,0.4,1]"},
};

class MyOpticalModel : public OpticalModelPlugin {
 public:
  // What the declarations cannot say; called when a config is validated.
  void check(const ParameterSet& p) const override {
    if (!(p.number("lower") < p.number("upper")))
      throw InputError(p.path_of("lower") + ": the window must begin below its upper end");
  }

  // The terms that the medium may have stand in framework/interfaces/medium.h.
  Medium medium(const ParameterSet& p, const ModelContext& context) const override {
    const double mu = p.number("extinction") / context.length_unit;  // per world unit
    Vector3 color = p.vector3("color");
    if (context.linear_color) std::transform(color.begin(), color.end(), color.begin(), display_to_linear);
    Nodes ramp;
    ramp.components = 1;
    ramp.node = {{p.number("lower"), {0, 0, 0}}, {p.number("upper"), {mu, mu, mu}}};
    const Curve tau(ramp), constant(color);
    MediumBuilder builder({&tau, &constant});
    builder.add(Term::tau_l, tau);
    builder.add_product(Term::P, constant, tau);
    return builder.take();
  }
};

}  // namespace

DVRLAB_PLUGIN("optical_model", "my_optical_model", "0.1", MyOpticalModel, parameters,
              "one colour whose extinction rises linearly over a window of values", "")

}  // namespace dvrlab::my_optical_model
