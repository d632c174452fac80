// The outcome of a run: what exec_svc wrote to summary.json, and what only the launcher knows.
#pragma once

#include <string>

#include "services/launch/options.hpp"

namespace roci::launch {

struct Summary {
  bool achieved = false;  // every hard goal
  std::string json;       // one line
  std::string text;       // for people
};

// Completes run_folder/summary.json (writes one with result "failed" if there is none) and reads it.
Summary complete_summary(const Options&, double wall_s);

}  // namespace roci::launch
