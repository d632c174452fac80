// This file fills facts and templates of facts as mission files write them: ?1 (a position), * (a family's
// object), {name} (a goal's argument).
#pragma once

#include <map>
#include <string>
#include <vector>

namespace roci::exec::mission {

/// Replaces ?1, ?2, … by arguments; a position without argument stays as it is.
std::string fill_positions(const std::string& text, const std::vector<std::string>& arguments);
std::string fill_star(const std::string& text, const std::string& object);
/// Replaces {name} by its value; an unknown name stays as it is.
std::string fill_names(const std::string& text, const std::map<std::string, std::string>& values);

/// Splits a fact into its words: "(at place-1)" → {"at", "place-1"}.
std::vector<std::string> words_of(const std::string& fact);

}  // namespace roci::exec::mission
