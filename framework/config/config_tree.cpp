#include "framework/config/config_tree.h"

#include <algorithm>

#include "framework/interfaces/error.h"

namespace dvrlab {
namespace {

bool is_index(const std::string& step) { return step.front() == '['; }
std::size_t index_of(const std::string& step) { return std::stoul(step.substr(1)); }

std::string parent_path(const std::string& path) {
  const std::size_t end = path.find_last_of(".[");
  return end == std::string::npos ? "" : path.substr(0, end);
}

std::string text_of(const Place& place, const std::string& path) {
  std::string text;
  if (!place.file.empty()) text += place.file + ":";
  if (place.line > 0) text += std::to_string(place.line) + ":" + std::to_string(place.column) + ":";
  if (!text.empty()) text += " ";
  return text + path;
}

}  // namespace

std::vector<std::string> split_path(const std::string& path) {
  std::vector<std::string> steps;
  if (path.empty()) return steps;
  std::size_t at = 0;
  for (;;) {
    const std::size_t end = std::min(path.find_first_of(".[", at + 1), path.size());
    const std::string step = path[at] == '.' ? "" : path.substr(at, end - at);
    if (step.empty()) throw InputError("'" + path + "' is no key path: a step is empty");
    const bool number = step.size() > 2 && step.size() < 8 && step.back() == ']' &&
                        step.find_first_not_of("0123456789", 1) == step.size() - 1;
    if (is_index(step) && !number) throw InputError("'" + path + "' is no key path: '" + step + "' is no index");
    steps.push_back(step);
    if (end == path.size()) return steps;
    at = path[end] == '.' ? end + 1 : end;
    if (at == path.size()) throw InputError("'" + path + "' is no key path: a step is empty");
  }
}

std::string wrong_path(const std::string& path) {
  try {
    const std::vector<std::string> steps = split_path(path);
    return steps.empty() || is_index(steps.front()) ? "'" + path + "' is no key path" : "";
  } catch (const InputError& e) {
    return e.what();
  }
}

bool lies_in(const std::string& path, const std::string& section) {
  if (path.compare(0, section.size(), section) != 0) return false;
  return path.size() == section.size() || section.empty() || path[section.size()] == '.' || path[section.size()] == '[';
}

std::string child_path(const std::string& path, const std::string& key) {
  return path.empty() ? key : path + "." + key;
}
std::string child_path(const std::string& path, std::size_t index) { return path + "[" + std::to_string(index) + "]"; }

const Place* ConfigTree::nearest(std::string path) const {
  for (;;) {
    const auto found = places_.find(path);
    if (found != places_.end()) return &found->second;
    if (path.empty()) return nullptr;
    path = parent_path(path);
  }
}

std::string ConfigTree::where(const std::string& path) const {
  const Place* place = nearest(path);
  if (place == nullptr) return path;
  const auto exact = places_.find(path);
  if (exact != places_.end()) return text_of(*place, place->path);
  // The nearest section that was written, then the rest of the path below it.
  std::string above = path;
  while (places_.find(above) == places_.end()) above = parent_path(above);
  const std::string rest = path.substr(above.size() + (above.empty() ? 0 : path[above.size()] == '.' ? 1 : 0));
  return text_of(*place, rest.front() == '[' ? place->path + rest : child_path(place->path, rest));
}

std::string ConfigTree::where_key(const std::string& path) const {
  const auto found = key_places_.find(path);
  return found == key_places_.end() ? where(path) : text_of(found->second, found->second.path);
}

std::string ConfigTree::located(const std::string& message) const {
  const std::size_t end = message.find(": ");
  const std::string path = message.substr(0, end);
  if (end == std::string::npos || path.find_first_of(" /\\\"'") != std::string::npos) return message;
  // A key that was not written has no place of its own: its section's, if that was written.
  const std::string section = path.substr(0, path.find_first_of(".["));
  return places_.contains(section) ? where(path) + message.substr(end) : message;
}

void ConfigTree::erase_places(const std::string& path) {
  auto it = places_.lower_bound(path);
  while (it != places_.end() && it->first.compare(0, path.size(), path) == 0) {
    it = lies_in(it->first, path) ? places_.erase(it) : std::next(it);
  }
}

void ConfigTree::graft(const std::string& path, const ConfigJson& value, const ConfigTree& from,
                       const std::string& from_path) {
  ConfigJson* node = &root;
  const bool one_of_several = !from_path.empty() && from_path.back() == ']';
  const Place* key_place = from.nearest(one_of_several ? parent_path(from_path) : from_path);
  const std::vector<std::string> steps = split_path(path);
  std::string above;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    const std::string& step = steps[i];
    if (i > 0 && node->is_null() && key_place != nullptr) {  // a section that is made: written where the path is
      places_[above] = {key_place->file, key_place->line, key_place->column, above};
    }
    above = is_index(step) ? above + step : child_path(above, step);
    if (is_index(step)) {
      if (!node->is_array() || index_of(step) >= node->size()) {
        throw InputError(from.where(from_path) + ": there is no '" + path + "' to set: the list has no element " +
                         step);
      }
      node = &(*node)[index_of(step)];
    } else {
      if (node->is_null()) *node = ConfigJson::object();
      if (!node->is_object()) {
        throw InputError(from.where(from_path) + ": there is no '" + path + "' to set: '" + step +
                         "' would lie in a plain value");
      }
      if (i + 1 < steps.size() && is_index(steps[i + 1]) && !node->contains(step)) {
        throw InputError(from.where(from_path) + ": there is no '" + path + "' to set: '" + step + "' was not written");
      }
      node = &(*node)[step];
    }
  }
  *node = value;
  erase_places(path);
  key_places_.erase(path);
  if (one_of_several && key_place != nullptr) key_places_[path] = *key_place;
  if (const Place* place = from.nearest(from_path)) {
    places_[path] = {place->file, place->line, place->column, from_path};
    // A list of numbers is one value: it is as good as its last number that was set.
    if (!steps.empty() && is_index(steps.back()) && value.is_primitive()) places_[parent_path(path)] = places_[path];
  }
  for (auto it = from.places_.lower_bound(from_path); it != from.places_.end(); ++it) {
    if (it->first.compare(0, from_path.size(), from_path) != 0) break;
    if (lies_in(it->first, from_path)) places_[path + it->first.substr(from_path.size())] = it->second;
  }
}

void ConfigTree::merge(const ConfigTree& from, const std::string& from_path, const ConfigJson& patch) {
  const auto merge_at = [&](const auto& self, const std::string& path, const std::string& source,
                            const ConfigJson& value) -> void {
    const ConfigJson* old = find(path);
    // The keys of axes and references are paths themselves, and cases as a whole are what is meant.
    const bool whole = path == "axes" || path == "reference" || !value.is_object() || value.contains("type");
    const bool section_by_section = !whole && old != nullptr && old->is_object();
    if (!section_by_section) return graft(path, value, from, source);
    for (const auto& [key, inner] : value.items()) self(self, child_path(path, key), child_path(source, key), inner);
  };
  for (const auto& [key, value] : patch.items()) merge_at(merge_at, key, child_path(from_path, key), value);
}

const ConfigJson* ConfigTree::find(const std::string& path) const {
  const ConfigJson* node = &root;
  for (const std::string& step : split_path(path)) {
    if (is_index(step)) {
      if (!node->is_array() || index_of(step) >= node->size()) return nullptr;
      node = &(*node)[index_of(step)];
    } else {
      if (!node->is_object() || !node->contains(step)) return nullptr;
      node = &(*node)[step];
    }
  }
  return node;
}

}  // namespace dvrlab
