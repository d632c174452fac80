// The outcome of a run joins what exec_svc wrote to summary.json and what only the launcher knows.
#pragma once

#include <string>

#include "services/launch/options.hpp"

namespace roci::services::launch {

/// Holds the outcome for programs and for people.
struct Summary {
  /// Says that every hard goal was achieved; where exec_svc does not run, that the services ended well.
  bool good = false;
  std::string json;  ///< one line
  std::string text;  ///< the same for people
};

/// Completes run_folder/summary.json and reads it. Where exec_svc flew here and left none, the result is
/// "failed". On a host without exec_svc, or with one of a pair that did not lead at the end, it is "served"
/// when its services `ended_well`: goals are counted where exec_svc leads. Throws std::runtime_error for a
/// summary of a newer format (services/service.hpp).
Summary complete_summary(const Options&, double wall_s, bool ended_well);

}  // namespace roci::services::launch
