// This file says what is said of unknown words.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace roci::rehearsal::check {

/// The remedy for an unknown word: "did you mean 'rover.nav'?", or where no word is near "known: a, b, c" with
/// at most twelve of them.
std::string instead_of(std::string_view word, const std::vector<std::string>& known);

bool contains(const std::vector<std::string>& words, std::string_view word);

/// The names between braces in a template, in order: "image-{id}" → {"id"}.
std::vector<std::string> slots_of(std::string_view text);

}  // namespace roci::rehearsal::check
