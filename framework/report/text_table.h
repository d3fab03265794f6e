// Columns of text, aligned.
#pragma once

#include <string>
#include <vector>

namespace dvrlab {

/// The first row is the heading. Two spaces between columns, none at the ends of lines.
std::string text_table(const std::vector<std::vector<std::string>>& rows);

/// A number in four digits, as tables for people show it.
std::string short_number(double x);

}  // namespace dvrlab
