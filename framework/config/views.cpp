#include "framework/config/views.h"

#include <algorithm>
#include <cmath>

#include "framework/config/check_value.h"
#include "framework/config/sections.h"

namespace dvrlab {
namespace {

const Parameter& views_parameter() {
  const std::vector<Parameter>& keys = find_section_type("camera", "orbit")->keys;
  return *std::find_if(keys.begin(), keys.end(), [](const Parameter& p) { return p.name == std::string("views"); });
}

bool is_orbit(const ConfigJson& type) { return type == "orbit"; }

bool makes_orbit(const AxisKey& key) {
  return std::any_of(key.values.begin(), key.values.end(), [&](const AxisValue& v) {
    if (key.key == "camera.type") return is_orbit(v.value);
    return key.key == "camera" && v.value.is_object() && v.value.contains("type") && is_orbit(v.value["type"]);
  });
}

/// Data, camera, everything else, variants.
int place_of(const Axis& axis) {
  if (axis.variant) return 3;
  const auto decides = [&](const char* section) {
    return std::any_of(axis.keys.begin(), axis.keys.end(), [&](const AxisKey& k) { return lies_in(k.key, section); });
  };
  return decides("data") ? 0 : decides("camera") ? 1 : 2;
}

}  // namespace

std::size_t asked_views(const ConfigTree& tree) {
  const ConfigJson* type = tree.find("camera.type");
  const ConfigJson* view = tree.find(view_key);
  if (type == nullptr || !is_orbit(*type) || (view != nullptr && !view->is_null())) return 0;
  const Parameter& p = views_parameter();
  const ConfigJson* written = tree.find("camera.views");
  const nlohmann::json views = written != nullptr ? nlohmann::json(*written) : nlohmann::json::parse(p.default_value);
  return wrong_value(p, views).empty() ? views.get<std::size_t>() : 0;
}

bool decides_views(const std::string& key) {
  return lies_in(view_key, key) || key == "camera.type" || key == "camera.views";
}

bool may_orbit(const ConfigTree& tree, const std::vector<Axis>& axes) {
  const ConfigJson* type = tree.find("camera.type");
  return (type != nullptr && is_orbit(*type)) || std::any_of(axes.begin(), axes.end(), [](const Axis& axis) {
           return std::any_of(axis.keys.begin(), axis.keys.end(), makes_orbit);
         });
}

std::size_t order_around_views(std::vector<Axis>& axes) {
  std::stable_sort(axes.begin(), axes.end(), [](const Axis& a, const Axis& b) { return place_of(a) < place_of(b); });
  return static_cast<std::size_t>(
      std::count_if(axes.begin(), axes.end(), [](const Axis& axis) { return place_of(axis) < 2; }));
}

std::string view_label(std::size_t view, std::size_t views) {
  const std::string label = std::to_string(view);
  const std::size_t length = std::to_string(views - 1).size();
  return std::string(length > label.size() ? length - label.size() : 0, '0') + label;
}

}  // namespace dvrlab
