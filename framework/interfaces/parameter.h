// The declaration of one parameter, as data. Everything else that speaks of the parameter (the value in a
// kernel's uniform block, the validator, `dvrlab describe`, the documentation table) is derived from it.
#pragma once

namespace dvrlab {

enum class ParameterType {
  boolean,   // true | false
  integer,   // whole number
  number,    // IEEE double, finite
  text,      // free text, e.g. a path
  choice,    // one word of `legal`
  vector3,   // [x, y, z]
  integer3,  // [i, j, k]
  nodes,     // transfer function nodes [[v, x], ...] or [[v, r, g, b], ...], or null for "not given"
  json       // a structure that the plugin reads itself; `summary` says which
};

/// What a changed value may change. The liveness contract test holds every parameter to its word.
enum class Affects { pixels, speed, nothing };

/// One parameter. Plain data: all strings are literals owned by the plugin.
struct Parameter {
  const char* name;  // the JSON key; "group.key" lies in a structure of its own: {"group": {"key": ...}}
  ParameterType type;
  const char* unit;           // "" when it has none
  const char* default_value;  // JSON text; nullptr when the key is required
  // integer, number, vector3, integer3: an interval such as "[0,inf)"; choice: "a|b|c"; nodes: components, "1", "3"
  // or "1|3"; json: what is legal, in words; else ""
  const char* legal;
  const char* summary;  // one sentence
  Affects affects;
  const char* live_in = "";     // JSON merge patch on the plugin's example config in which `live_value` must act
  const char* live_value = "";  // JSON text of a second legal value for the liveness test
  // "field=ramp|radial": the key is read only when the choice `field` of the same section is one of these; written
  // with another it is refused, and resolved configs leave it out. "": always read.
  const char* only_with = "";
  const char* schema = "";  // json: JSON Schema of the structure, one object; "": anything
};

}  // namespace dvrlab
