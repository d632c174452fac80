#include "core/temporal/function_values.hpp"

#include <algorithm>
#include <set>

namespace roci::temporal {
namespace {

bool in_order(const std::vector<std::string>& some, const std::vector<std::string>& all) {
  auto at = all.begin();
  return std::ranges::all_of(some, [&](const std::string& one) {
    at = std::find(at, all.end(), one);
    return at != all.end() && (++at, true);
  });
}

// Each as often as it stands there.
bool among(const std::vector<std::string>& some, const std::vector<std::string>& all) {
  return std::ranges::all_of(some, [&](const std::string& one) {
    return std::ranges::count(some, one) <= std::ranges::count(all, one);
  });
}

}  // namespace

std::vector<std::size_t> function_values_of(const std::vector<std::string>& arguments,
                                            std::span<const FunctionValueUse> values) {
  std::set<std::string> ordered;  // functions
  for (const FunctionValueUse& value : values)
    if (in_order(value.arguments, arguments)) ordered.insert(value.function);
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const bool fits = ordered.contains(values[i].function) ? in_order(values[i].arguments, arguments)
                                                           : among(values[i].arguments, arguments);
    if (fits) out.push_back(i);
  }
  return out;
}

}  // namespace roci::temporal
