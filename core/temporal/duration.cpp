#include "core/temporal/duration.hpp"

#include <array>
#include <cstdio>

namespace roci::temporal {

std::string to_text(Duration d) {
  if (!bounded(d)) return d == no_bound ? "unbounded" : "-unbounded";
  std::array<char, 40> text{};
  const std::int64_t whole = d.count() / 1'000'000;
  const std::int64_t rest = d.count() % 1'000'000;
  const char* sign = d.count() < 0 ? "-" : "";
  std::snprintf(text.data(), text.size(), "%s%lld.%06lld", sign,
                static_cast<long long>(whole < 0 ? -whole : whole),
                static_cast<long long>(rest < 0 ? -rest : rest));
  std::string shortened = text.data();
  shortened.erase(shortened.find_last_not_of('0') + 1);
  if (shortened.back() == '.') shortened.pop_back();
  return shortened + " s";
}

}  // namespace roci::temporal
