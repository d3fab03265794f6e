// The medium of a case: its optical model's, checked against what its estimator can integrate.
#pragma once

#include <string>
#include <vector>

#include "framework/config/resolved_case.h"
#include "framework/interfaces/estimator.h"
#include "framework/interfaces/field.h"
#include "framework/interfaces/illumination.h"
#include "framework/interfaces/medium.h"
#include "framework/plugin/registry.h"
#include "framework/scene/medium_table.h"

namespace dvrlab {

/// In values of tf_domain; `voxel` is the data's smallest spacing in world units, [value_min, value_max] its range in
/// those values. What is capped or approximated is added to `notes`.
Medium model_medium(const ResolvedCase& c, const Registry& registry, double voxel, double value_min, double value_max,
                    std::vector<std::string>& notes);

/// Of the field's values, per stored value, with the same notes.
Medium stored_medium(const ResolvedCase& c, const Registry& registry, const Field& field,
                     std::vector<std::string>& notes);

/// Throws InputError when the medium has terms that the estimator does not handle, or a table where it needs nodes.
void refuse_impossible(const ResolvedCase& c, const Medium& medium, const EstimatorDeclaration& d);

/// Where the medium's table lies, but for `rgb`, `full`, `lit_particles` and `fold_shaded`.
MediumTableOptions table_options(const ResolvedCase& c, const Field& field);

/// All of it: what the kernels' variant for this medium and this light asks for.
MediumTableOptions table_options(const ResolvedCase& c, const Field& field, const Medium& medium,
                                 const LocalShading& light, const EstimatorDeclaration& d);

/// What an estimator is told of that before its tables are made.
TableLayout table_layout(const ResolvedCase& c, const Medium& medium, const MediumTableOptions& options);

}  // namespace dvrlab
