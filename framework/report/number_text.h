// A number as people read it.
#pragma once

#include <string>

namespace dvrlab {

/// With at most so many digits: "0.25", "1e+300".
std::string number_text(double x, int digits = 6);

}  // namespace dvrlab
