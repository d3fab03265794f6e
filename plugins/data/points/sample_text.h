// Samples at scattered places, as lines of numbers.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "framework/interfaces/parameter_set.h"

namespace dvrlab::points {

struct Samples {
  std::vector<Vector3> place;
  std::vector<double> value;
};

/// Lines "x y z ... value ...", separated by blanks, tabs, commas or semicolons; lines that begin with # or with a
/// letter (a head line) and empty ones are passed over. `column`: of the value, from 0; the places are the first three.
/// Throws InputError naming the line.
Samples read_samples(std::span<const std::byte> file, long long column, const std::string& name);

}  // namespace dvrlab::points
