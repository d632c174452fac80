#pragma once
#include <map>
#include <string>
#include <vector>

#include "sim_svc/values.hpp"

namespace roci::sim {

/// Turns what is true into observations: only what changed since it was last reported.
class Reporter {
 public:
  void report(const std::string& timeline, Value value, Time at, std::vector<Output>& out);
  /// Rounded to a multiple of the sensor's resolution.
  void report_number(const std::string& timeline, double value, double resolution, Time at,
                     std::vector<Output>& out);

 private:
  std::map<std::string, Value> last_;
};

}  // namespace roci::sim
