#include "exec_svc/journal/round_trips.hpp"

#include <cstdint>
#include <sstream>

namespace roci::exec::journal {

std::string round_trips_text(const RoundTrips& round_trips) {
  std::string out;
  for (const auto& [owner, time] : round_trips) out += owner + " " + std::to_string(time.count()) + "\n";
  return out;
}

RoundTrips round_trips_of(std::string_view text) {
  RoundTrips out;
  std::istringstream lines{std::string(text)};
  std::string owner;
  for (std::int64_t us = 0; lines >> owner >> us;) out[owner] = temporal::Duration(us);
  return out;
}

}  // namespace roci::exec::journal
