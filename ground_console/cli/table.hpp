// This file sets text in columns.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace roci::console::cli {

/// Columns that a UTF-8 text takes on a terminal, one for each code point.
std::size_t columns_of(std::string_view text);

/// The words in one line, with `between` between them.
std::string joined(const std::vector<std::string>& words, const char* between);

/// The first row is the head. Each column is as wide as its widest cell; two blanks between them, none at the end of a
/// line. Control characters become "?".
std::string table_text(const std::vector<std::vector<std::string>>& rows);

}  // namespace roci::console::cli
