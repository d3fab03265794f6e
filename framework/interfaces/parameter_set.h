// The resolved values of one config section: every declared key has a legal value.
#pragma once

#include <array>
#include <memory>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "framework/interfaces/parameter.h"

namespace dvrlab {

using Vector3 = std::array<double, 3>;

/// One transfer function node: `x` holds 1 or 3 components (the first one is repeated when there is one).
struct Node {
  double value;
  Vector3 x;
};

/// A transfer function as it was written. Empty when the key was null.
struct Nodes {
  std::vector<Node> node;
  int components = 0;  // 1 or 3; 0 when empty
  bool empty() const { return node.empty(); }
};

/// Read access to a resolved section. A name that was not declared throws std::logic_error: a programming
/// error in the plugin, never a user's.
class ParameterSet {
 public:
  ParameterSet();
  /// `declared` must outlive the set; `values` is an object that holds every declared key, validated.
  /// `path` is the section's place in the config ("optical_model"), used by errors.
  ParameterSet(std::string path, std::vector<Parameter> declared, const nlohmann::json& values);

  bool boolean(const std::string& name) const;
  long long integer(const std::string& name) const;
  double number(const std::string& name) const;
  std::string text(const std::string& name) const;
  /// The index of the chosen word in the declaration's list.
  int choice_index(const std::string& name) const;
  Vector3 vector3(const std::string& name) const;
  std::array<int, 3> integer3(const std::string& name) const;
  Nodes nodes(const std::string& name) const;
  const nlohmann::json& json(const std::string& name) const;
  bool is_null(const std::string& name) const;

  const std::vector<Parameter>& declared() const { return declared_; }
  const std::string& path() const { return path_; }
  /// "optical_model.opacity": the key's place, for errors.
  std::string path_of(const std::string& name) const;

 private:
  const nlohmann::json& value(const std::string& name) const;
  std::string path_;
  std::vector<Parameter> declared_;
  std::shared_ptr<const nlohmann::json> values_;
};

}  // namespace dvrlab
