#include "framework/interfaces/parameter_set.h"

#include <nlohmann/json.hpp>
#include <stdexcept>

#include "framework/config/key_pointer.h"
#include "framework/config/words.h"

namespace dvrlab {

ParameterSet::ParameterSet() : values_(std::make_shared<const nlohmann::json>(nlohmann::json::object())) {}

ParameterSet::ParameterSet(std::string path, std::vector<Parameter> declared, const nlohmann::json& values)
    : path_(std::move(path)), declared_(std::move(declared)), values_(std::make_shared<const nlohmann::json>(values)) {}

bool ParameterSet::boolean(const std::string& name) const { return value(name).get<bool>(); }
long long ParameterSet::integer(const std::string& name) const { return value(name).get<long long>(); }
double ParameterSet::number(const std::string& name) const { return value(name).get<double>(); }
std::string ParameterSet::text(const std::string& name) const { return value(name).get<std::string>(); }

int ParameterSet::choice_index(const std::string& name) const {
  const std::string chosen = text(name);
  for (const Parameter& p : declared_) {
    if (name != p.name) continue;
    const std::vector<std::string> words = split_words(p.legal);
    for (std::size_t i = 0; i < words.size(); ++i) {
      if (words[i] == chosen) return static_cast<int>(i);
    }
  }
  throw std::logic_error("parameter '" + path_of(name) + "' is no choice with the word '" + chosen + "'");
}

Vector3 ParameterSet::vector3(const std::string& name) const { return value(name).get<Vector3>(); }
std::array<int, 3> ParameterSet::integer3(const std::string& name) const {
  return value(name).get<std::array<int, 3>>();
}

Nodes ParameterSet::nodes(const std::string& name) const {
  Nodes nodes;
  const nlohmann::json& list = value(name);
  if (list.is_null()) return nodes;
  for (const nlohmann::json& row : list) {
    const bool grey = row.size() == 2;
    nodes.components = grey ? 1 : 3;
    const double x = row.at(1).get<double>();
    nodes.node.push_back(
        {row.at(0).get<double>(), {x, grey ? x : row.at(2).get<double>(), grey ? x : row.at(3).get<double>()}});
  }
  return nodes;
}

const nlohmann::json& ParameterSet::json(const std::string& name) const { return value(name); }
bool ParameterSet::is_null(const std::string& name) const { return value(name).is_null(); }

std::string ParameterSet::path_of(const std::string& name) const { return path_.empty() ? name : path_ + "." + name; }

const nlohmann::json& ParameterSet::value(const std::string& name) const {
  const auto place = key_pointer(name);
  if (!values_->contains(place)) throw std::logic_error("parameter '" + path_of(name) + "' was not declared");
  return (*values_)[place];
}

}  // namespace dvrlab
