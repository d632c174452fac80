#include "sim_svc/world/reporter.hpp"

#include <cmath>

namespace roci::sim::world {

void Reporter::report(const std::string& timeline, temporal::Value value, temporal::Time at, Outputs& out) {
  const auto [last, is_new] = last_.try_emplace(timeline, value);
  if (!is_new && last->second == value) return;
  last->second = value;
  out.push_back(Observed{timeline, std::move(value), at, false});
}

void Reporter::end(const std::string& timeline, temporal::Time at, Outputs& out) {
  const auto last = last_.find(timeline);
  if (last == last_.end()) return;
  out.push_back(Observed{timeline, last->second, at, true});
  last_.erase(last);
}

void Reporter::report_number(const std::string& timeline, double value, double resolution, temporal::Time at,
                             Outputs& out) {
  // Dividing by the whole number 1 / resolution gives the double nearest to the decimal fraction; + 0.0 turns
  // -0 into 0.
  const double steps = std::round(1 / resolution);
  report(timeline, std::round(value * steps) / steps + 0.0, at, out);
}

}  // namespace roci::sim::world
