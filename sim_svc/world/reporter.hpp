// The reporter observes what has changed.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "sim_svc/world/values.hpp"

namespace roci::sim::world {

/// Turns what is true into observations; it reports only what changed since it was last reported.
class Reporter {
 public:
  void report(const std::string& timeline, temporal::Value value, temporal::Time at, Outputs& out);
  /// Reports that the timeline has ended, with the value that it has had last, and forgets it.
  void end(const std::string& timeline, temporal::Time at, Outputs& out);
  /// Reports the value rounded to a multiple of the sensor's resolution.
  void report_number(const std::string& timeline, double value, double resolution, temporal::Time at,
                     Outputs& out);

 private:
  std::map<std::string, temporal::Value> last_;
};

}  // namespace roci::sim::world
