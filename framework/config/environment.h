// "${NAME}" in the texts of a config that name files and folders.
#pragma once

#include <string>

namespace dvrlab {

/// The text with every "${NAME}" replaced by the value of that environment variable; a value is not expanded again.
/// Throws InputError, `where` (place or key path) in front, for a variable that is not set or a "${" that does not end.
std::string expand_environment(const std::string& text, const std::string& where);

}  // namespace dvrlab
