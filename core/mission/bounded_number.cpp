#include "core/mission/bounded_number.hpp"

#include <string>

namespace roci::mission {

double bounded_number(const std::optional<Entry>& entry, std::string_view key, double fallback, double least,
                      double most) {
  if (!entry) return fallback;
  const double value = entry->number();
  if (value < least || value > most) {
    entry->fail("'" + std::string(key) + "' must lie between " + std::to_string(least) + " and " +
                std::to_string(most) + "; correct the number");
  }
  return value;
}

}  // namespace roci::mission
