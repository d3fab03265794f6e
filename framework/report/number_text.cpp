#include "framework/report/number_text.h"

#include <cstdio>

namespace dvrlab {

std::string number_text(double x, int digits) {
  char text[40];
  std::snprintf(text, sizeof text, "%.*g", digits, x);
  return text;
}

}  // namespace dvrlab
