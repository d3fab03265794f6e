// How the texts of starter configs are filled in.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "framework/app/data_input.h"

namespace dvrlab {

/// Words by name.
using StarterWords = std::map<std::string, std::string, std::less<>>;

/// The form with the words in place of their names, which stand between dollar signs. All are there.
std::string filled(std::string_view form, const StarterWords& words);

/// The data section that reads this data from a config in `folder`: its path is relative where the file lies near, so
/// that both can be moved together.
std::string data_section_in(const std::string& folder, const LoadedData& data);
/// The name of its file, without folders.
std::string file_name_of(const LoadedData& data);

std::string vector_text(const Vector3& v);
/// "[value, rest]"
std::string node_text(double value, const std::string& rest);

/// Which way the axes point, a sentence.
std::string axes_text(const Field& field);

}  // namespace dvrlab
