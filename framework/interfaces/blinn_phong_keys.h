// The keys of Blinn-Phong shading, for every pass that lights with it.
#pragma once

#include "framework/interfaces/illumination.h"

namespace dvrlab {

inline constexpr Parameter ambient_key{"ambient",
                                       ParameterType::number,
                                       "",
                                       "0.2",
                                       "[0,inf)",
                                       "k_a: factor of the colour without any light.",
                                       Affects::pixels,
                                       "",
                                       "0.4"};
inline constexpr Parameter diffuse_key{
    "diffuse", ParameterType::number, "", "0.7", "[0,inf)", "k_d: factor of |N.L|.", Affects::pixels, "", "0.3"};
inline constexpr Parameter specular_key{"specular",
                                        ParameterType::number,
                                        "",
                                        "0.3",
                                        "[0,inf)",
                                        "k_s: factor of |N.H|^shininess, added uncoloured.",
                                        Affects::pixels,
                                        "",
                                        "0.1"};
inline constexpr Parameter shininess_key{"shininess",
                                         ParameterType::integer,
                                         "",
                                         "20",
                                         "[1,1024]",
                                         "Exponent of the highlight: a whole number.",
                                         Affects::pixels,
                                         "",
                                         "5"};
inline constexpr Parameter two_sided_key{"two_sided",
                                         ParameterType::boolean,
                                         "",
                                         "true",
                                         "",
                                         "Both sides of a surface are lit; otherwise only the one facing the light.",
                                         Affects::pixels,
                                         "",
                                         "false"};
inline constexpr Parameter gradient_eps_key{
    "gradient_eps",
    ParameterType::number,
    "value/length",
    "1e-6",
    "[0,inf)",
    "Gradient magnitude (physical value per world unit) below which there is no normal: k = ambient + diffuse.",
    Affects::pixels,
    "",
    "1000"};

/// Sets mode and coefficients from the keys above; gradient_eps stays.
inline void shade_blinn_phong(const ParameterSet& p, LocalShading& s) {
  s.mode = LocalShading::Mode::blinn_phong;
  s.ambient = p.number("ambient");
  s.diffuse = p.number("diffuse");
  s.specular = p.number("specular");
  s.shininess = static_cast<int>(p.integer("shininess"));
  s.two_sided = p.boolean("two_sided");
}

}  // namespace dvrlab
