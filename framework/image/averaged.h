// Several rays per pixel.
#pragma once

#include "framework/interfaces/backend.h"

namespace dvrlab {

/// The image whose pixels are the means of n x n pixels, in fp64 and in a fixed order; n = 1 is the image itself. Its
/// sides are multiples of n.
FrameImage averaged(FrameImage image, int n);

}  // namespace dvrlab
