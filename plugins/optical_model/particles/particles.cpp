// Sabella's density emitter: a cloud of glowing spherical particles (Sabella 1988; Max, Hanrahan and Crawfis 1990;
// Williams and Max 1992, section 2).
#include <algorithm>
#include <nlohmann/json.hpp>

#include "framework/interfaces/error.h"
#include "framework/interfaces/transfer_function.h"

namespace dvrlab::particles {
namespace {

using enum ParameterType;

constexpr Parameter parameters[] = {
    {"density", nodes, "", nullptr, "1", "Share of the space that particles fill: nodes [value, rho] in [0, 1].",
     Affects::pixels, "", "[[0,0.02],[1,0.1]]"},
    {"radius", number, "length_unit", "0.1", "(0,inf)", "Of a particle; the extinction is 3 / (4 radius) per density.",
     Affects::pixels, "", "0.05"},
    {"glow", vector3, "", "[1,1,1]", "", "Intensity kappa of the particles' surfaces per channel, at least 0.",
     Affects::pixels, "", "[0.2,0.9,0.5]"},
    {"tau", vector3, "1/length_unit", "[0,0,0]", "",
     "Extinction per density and channel, which scales the density differently for each channel; [0,0,0]: 3 / (4 "
     "radius) "
     "for all.",
     Affects::pixels, "", "[2,8,4]"},
};

class Particles : public OpticalModelPlugin {
 public:
  void check(const ParameterSet& p) const override {
    for (const Node& n : p.nodes("density").node)
      if (n.x[0] < 0 || n.x[0] > 1)
        throw InputError(p.path_of("density") + ": " + nlohmann::json(n.x[0]).dump() + " at value " +
                         nlohmann::json(n.value).dump() + "; a share of space lies in [0, 1]");
    for (const char* key : {"glow", "tau"}) {
      for (const double x : p.vector3(key))
        if (x < 0) throw InputError(p.path_of(key) + ": " + nlohmann::json(x).dump() + "; must be at least 0");
    }
  }

  Medium medium(const ParameterSet& p, const ModelContext& context) const override {
    const Curve density(p.nodes("density"));
    const double fullest =
        std::max_element(density.nodes().begin(), density.nodes().end(), [](const Node& a, const Node& b) {
          return a.x[0] < b.x[0];
        })->x[0];
    constexpr double sparse = 0.1;
    if (fullest > sparse)
      context.notes->push_back(p.path_of("density") + ": reaches " + nlohmann::json(fullest).dump() +
                               "; particles that are placed independently overlap there, and the model is rough");
    const Vector3 given = p.vector3("tau"), glow = p.vector3("glow");
    const bool by_radius = given == Vector3{0, 0, 0};
    Vector3 tau;
    for (std::size_t c = 0; c < 3; ++c)
      tau[c] = (by_radius ? 3 / (4 * p.number("radius")) : given[c]) / context.length_unit;
    Curve extinction = density, source = density;
    for (std::size_t k = 0; k < density.nodes().size(); ++k)
      for (std::size_t c = 0; c < 3; ++c) {
        const double rho = density.nodes()[k].x[0];
        extinction.nodes()[k].x[c] = tau[c] * rho;
        source.nodes()[k].x[c] = glow[c] * tau[c] * rho;
      }
    MediumBuilder builder({&extinction});
    builder.add(Term::tau_l, extinction);
    builder.add(Term::E, source);
    return builder.take();
  }
};

}  // namespace

DVRLAB_PLUGIN("optical_model", "particles", "1.0", Particles, parameters,
              "a cloud of glowing spherical particles: density, particle radius and glow",
              "P. Sabella, A Rendering Algorithm for Visualizing 3D Scalar Fields, SIGGRAPH 1988, "
              "doi:10.1145/54852.378476; N. Max, P. Hanrahan, R. Crawfis, Area and Volume Coherence for Efficient "
              "Visualization of 3D Scalar Functions, 1990; P. Williams and N. Max 1992, section 2")

}  // namespace dvrlab::particles
