// The rays of the image, and what a pass is told that finds it itself.
#pragma once

#include "framework/config/resolved_case.h"
#include "framework/interfaces/field.h"
#include "framework/interfaces/illumination.h"
#include "framework/interfaces/medium.h"
#include "framework/scene/medium_table.h"

namespace dvrlab {

/// Columns and rows of rays: pixels times `supersampling`.
std::array<int, 2> rays_of_image(const ResolvedCase& c);

ImageSetting image_setting(const ResolvedCase& c, const Field& field, const Medium& medium,
                           const MediumTableOptions& options);

}  // namespace dvrlab
