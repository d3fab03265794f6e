// One type of a section as JSON Schema: its keys, and which of them a choice does not read.
#include <algorithm>

#include "framework/config/schema_parts.h"
#include "framework/config/words.h"

namespace dvrlab {
namespace {

/// A key that is read only with some words of a choice.
void add_unread(const Parameter& p, const std::vector<Parameter>& keys, Schema& unread, Schema& by_default) {
  if (*p.only_with == '\0') return;
  const std::vector<std::string> condition = split_words(p.only_with, '='), readers = split_words(condition.at(1));
  const auto reads = [&](const std::string& w) {
    return std::find(readers.begin(), readers.end(), w) != readers.end();
  };
  for (const Parameter& choice : keys) {
    if (choice.name != condition[0]) continue;
    std::vector<std::string> others = split_words(choice.legal);
    std::erase_if(others, reads);
    const Schema refuse = {{"properties", {{p.name, false}}}};
    unread.push_back(when({{"required", {choice.name}}, {"properties", {{choice.name, {{"enum", others}}}}}}, refuse));
    if (choice.default_value != nullptr && !reads(Schema::parse(choice.default_value).get<std::string>()))
      by_default.push_back(when({{"not", has(choice.name)}}, refuse));
  }
}

/// A key, or a key of a group, which is a section of its own ("surface.opacity").
void add_property(const Parameter& p, Schema& properties) {
  const std::string name = p.name;
  const std::size_t dot = name.find('.');
  if (dot == std::string::npos) {
    properties[name] = value_schema(p);
    return;
  }
  Schema& group = properties[name.substr(0, dot)];
  if (group.is_null()) group = {{"type", "object"}, {"properties", Schema::object()}, {"additionalProperties", false}};
  group["properties"][name.substr(dot + 1)] = value_schema(p);
}

}  // namespace

void define_branch(const std::string& name, const SchemaBranch& b, Schema& definitions) {
  Schema properties = Schema::object(), required = Schema::array();
  if (!b.type.empty()) properties["type"] = {{"const", b.type}, {"description", b.summary}};
  for (const Parameter& p : b.keys) {
    add_property(p, properties);
    if (p.default_value == nullptr) required.push_back(p.name);
  }
  Schema unread = Schema::array(), unread_by_default = Schema::array();
  for (const Parameter& p : b.keys) add_unread(p, b.keys, unread, unread_by_default);
  definitions[name] = {
      {"type", "object"}, {"description", b.summary}, {"properties", properties}, {"additionalProperties", false}};
  if (!unread.empty()) definitions[name]["allOf"] = unread;
  unread_by_default.insert(unread_by_default.begin(), refer(name));
  definitions["complete-" + name] = {{"required", required}, {"allOf", unread_by_default}};
}

}  // namespace dvrlab
