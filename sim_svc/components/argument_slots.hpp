// This file fills words of settings in which braces name arguments of a command: trench_{site}.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/mission/entry.hpp"

namespace roci::sim::components {

/// Returns the word with each argument in place of its name in braces.
std::string fill_slots(std::string word, const std::map<std::string, std::string>& arguments);

/// Throws mission::FileError when braces of the word name none of the command's arguments.
void check_slots(const mission::Entry&, std::string word, const std::string& command,
                 const std::vector<std::string>& arguments);

}  // namespace roci::sim::components
