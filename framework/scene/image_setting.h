// What a pass is told that finds the image itself.
#pragma once

#include "framework/config/resolved_case.h"
#include "framework/interfaces/field.h"
#include "framework/interfaces/illumination.h"
#include "framework/interfaces/medium.h"
#include "framework/scene/medium_table.h"

namespace dvrlab {

ImageSetting image_setting(const ResolvedCase& c, const Field& field, const Medium& medium,
                           const MediumTableOptions& options);

}  // namespace dvrlab
