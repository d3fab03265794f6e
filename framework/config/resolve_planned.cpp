#include "framework/config/resolve_planned.h"

#include <set>

#include "framework/config/resolve.h"
#include "framework/config/views.h"
#include "framework/interfaces/error.h"
#include "framework/interfaces/field.h"
#include "framework/scene/check_case.h"

namespace dvrlab {
namespace {

/// A case is one image: no orbit is left whose view is null.
void refuse_open_views(const ConfigTree& tree, const PlannedCase& c, Problems& problems) {
  const std::size_t views = asked_views(tree);
  if (views == 0) return;
  const bool variant = c.reference_name.empty();
  problems.add(tree.where("camera") + ": " +
               (variant ? "the values of a variant axis show one image"
                        : "the reference '" + c.reference_name + "' is one image") +
               ", this orbit has " + std::to_string(views) + "; give the index of a view" +
               (variant ? "" : ", or change single keys of the camera"));
}

/// Data that is missing is found before the first case runs, unless it may be missing.
void check_data_file(const ConfigTree& tree, const ResolvedCase& c, Problems& problems) {
  const nlohmann::json& data = c.config.at("data");
  if (!data.is_object()) return;
  if (data.value("optional", nlohmann::json()) == true || !data.contains("file") || !data["file"].is_string()) return;
  LoadContext context;
  context.base_folder = c.base_folder;
  try {
    resolve_path(data["file"].get<std::string>(), context, "data.file");
  } catch (const InputError& e) {
    problems.add(tree.located(e.what()));
  }
}

void check(const ConfigTree& tree, const ResolvedCase& c, const Registry& registry, Problems& problems) {
  std::set<std::string> metrics;
  for (const Section& m : c.metrics) {
    if (!metrics.insert(m.type).second)
      problems.add(tree.where("metrics") + ": metric '" + m.type + "' is listed twice (keep one)");
  }
  Problems found;
  check_case(c, registry, found);
  for (const std::string& line : found.lines()) problems.add(tree.located(line));
}

}  // namespace

void resolve_planned(const ConfigTree& tree, const std::string& base_folder, const Registry& registry, PlannedCase& c,
                     Problems& problems) {
  Problems mine;
  refuse_open_views(tree, c, mine);
  c.resolved = resolve_case(tree, base_folder, registry, mine);
  const bool resolved = mine.empty();
  check_data_file(tree, c.resolved, mine);
  if (resolved) check(tree, c.resolved, registry, mine);
  problems.add(mine);
}

}  // namespace dvrlab
