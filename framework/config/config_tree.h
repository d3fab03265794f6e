// A config as it was written: its values, and for every key where it stands.
#pragma once

#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dvrlab {

/// Keeps the order in which keys were written: axes are varied in that order.
using ConfigJson = nlohmann::ordered_json;

/// Where a key was written. `path` is its path there: an axis value that ends up at "estimator" was written at
/// "axes.permutation.estimator[2]". Line and column count from 1; line 0: not in a file.
struct Place {
  std::string file;
  int line = 0, column = 0;
  std::string path;
};

/// "lights[0].color" -> {"lights", "[0]", "color"}; "" -> {}. Throws InputError for an empty step ("sampling..step")
/// and for an index that is none.
std::vector<std::string> split_path(const std::string& path);
/// "" or why this is no path of a key: what split_path refuses, no step, or an index in front.
std::string wrong_path(const std::string& path);
/// True if `path` is `section` or lies below it: who sets `section` decides `path`.
bool lies_in(const std::string& path, const std::string& section);
std::string child_path(const std::string& path, const std::string& key);
std::string child_path(const std::string& path, std::size_t index);

class ConfigTree {
 public:
  ConfigJson root = ConfigJson::object();

  void set_place(const std::string& path, Place place) { places_[path] = std::move(place); }
  /// Forgets where the key and everything below it was written.
  void erase_places(const std::string& path);
  /// "file:3:5: estimator.step" for messages; a key that was not written has the place of the section that lacks it.
  std::string where(const std::string& path) const;
  /// The same for a mistake in the key itself: an axis key is one key, however many values it has.
  std::string where_key(const std::string& path) const;

  /// A message that begins with a key's path ("camera.up: is ...") with that key's place in front. Others are kept.
  std::string located(const std::string& message) const;

  /// Puts the value at `from_path` of `from` at `path`, with its places. Sections on the way are made, and are written
  /// there. `value` is usually what stands there; a range makes its own. Throws InputError when the path leads through
  /// a value that is no section.
  void graft(const std::string& path, const ConfigJson& value, const ConfigTree& from, const std::string& from_path);

  /// Merges the section at `from_path` of `from` over this tree: a section that names its type, a list and a plain
  /// value replace what is there, and so do axes and reference; the keys of any other section are merged one by
  /// one. Keys may be paths ("sampling.step").
  void merge(const ConfigTree& from, const std::string& from_path, const ConfigJson& patch);

  /// The value at the path, nullptr when there is none.
  const ConfigJson* find(const std::string& path) const;

 private:
  const Place* nearest(std::string path) const;
  std::map<std::string, Place> places_;
  std::map<std::string, Place> key_places_;  // where the value is one of several that were written below the key
};

}  // namespace dvrlab
