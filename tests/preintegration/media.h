// Media for the tests of pre-integration tables.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>

#include "framework/interfaces/medium.h"

namespace dvrlab::test {

/// A medium or case of golden/public.json of one of the models absorption_emission (tau, color; source in P), kraus and
/// hybrid without absorption and emission (a_s, c_s; a_ps, c_ps, source in P; Diracs).
Medium golden_medium(const nlohmann::json& golden);

struct RandomMedium {
  bool rgb = false;
  int diracs = 0;
  bool opaque_spikes = false;  // intervals with a depth of about 1e4 per cell of a table with 64 values, h = 1
};

/// Every term in use: random quadratics with jumps in 9 intervals over [0.1, 0.9], random Diracs in [0, 1], two of them
/// at 1/4 and in the same cell as the one before when there are 3 or more.
Medium random_medium(std::uint32_t seed, const RandomMedium& what);

}  // namespace dvrlab::test
