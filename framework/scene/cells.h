// Sampling "cells": segments on which the scalar is linear to a tolerance (framework/kernel/cells.kernel).
#pragma once

#include "framework/config/resolved_case.h"
#include "framework/interfaces/field.h"
#include "framework/interfaces/kernel_unit.h"
#include "framework/scene/medium_table.h"

namespace dvrlab {

/// True for `sampling.type` "cells".
bool samples_cells(const ResolvedCase& c);

/// Throws InputError for a precision other than fp64: the walk exists in double only.
void check_cells(const ResolvedCase& c);

/// Adds frame_cells, frame_cells_* to the frame of a case that samples cells. `along` is what the field's sampler says;
/// throws InputError naming `sampler` when that is none.
void add_cells(const ResolvedCase& c, const Field& field, AlongRay along, const std::string& sampler,
               const OccupiedBins& occupied, KernelUnit& unit);

}  // namespace dvrlab
