// The one case of a config without axes, or of a data file, for the verbs that work on one.
#pragma once

#include <memory>

#include "framework/app/verbs.h"
#include "framework/config/experiment.h"
#include "framework/interfaces/field.h"
#include "framework/plugin/registry.h"

namespace dvrlab {

struct SingleCase {
  PlannedCase planned;
  std::shared_ptr<const Field> field;  // of its data section; nullptr when nobody had to load it so far
};

/// Throws InputError when the config asks for more than one case.
SingleCase single_case(const Options& options, const Registry& registry);

}  // namespace dvrlab
