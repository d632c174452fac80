#include "dedicated_svc/methods/fill.hpp"

namespace roci::dedicated::methods {
namespace {

// Calls `plain` with each stretch of text, and `name` with each name in braces; false for braces that do not match.
bool split(std::string_view text, const std::function<void(std::string_view)>& plain,
           const std::function<void(std::string_view)>& name) {
  while (!text.empty()) {
    const std::size_t brace = text.find_first_of("{}");
    plain(text.substr(0, brace));
    if (brace == std::string_view::npos) return true;
    if (text[brace] == '}') return false;
    const std::size_t end = text.find_first_of("{}", brace + 1);
    if (end == std::string_view::npos || text[end] != '}' || end == brace + 1) return false;
    name(text.substr(brace + 1, end - brace - 1));
    text.remove_prefix(end + 1);
  }
  return true;
}

}  // namespace

std::optional<std::vector<std::string>> names_in(std::string_view text) {
  std::vector<std::string> names;
  if (!split(
          text, [](std::string_view) {}, [&](std::string_view name) { names.emplace_back(name); }))
    return {};
  return names;
}

std::optional<std::string> fill(
    std::string_view text, const std::function<std::optional<std::string>(const std::string&)>& value_of) {
  std::string out;
  bool known = true;
  split(
      text, [&](std::string_view plain) { out += plain; },
      [&](std::string_view name) {
        const auto value = value_of(std::string(name));
        known = known && value;
        if (value) out += *value;
      });
  if (!known) return {};
  return out;
}

}  // namespace roci::dedicated::methods
