// Colour differences as a picture.
#pragma once

#include "framework/interfaces/backend.h"

namespace dvrlab {

/// Delta E in L*u*v* of every pixel (luv.h): grey below 1, the just noticeable difference, so that what an eye could
/// not see has no colour; from 1 on blue, green at 3, yellow at 6, red from 12. Below the picture stands the scale,
/// with marks at 1, 3, 6 and 12. The images have one size.
FrameImage difference_image(const FrameImage& a, const FrameImage& b, bool linear);

}  // namespace dvrlab
