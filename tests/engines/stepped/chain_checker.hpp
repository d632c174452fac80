// The check of each version that ChainEngine makes: it shares no more with it than the reader of models.
#pragma once

#include "planner_svc/engine/checker.hpp"

namespace roci::planner::proof {

class ChainChecker final : public engine::Checker {
 public:
  std::vector<std::string> faults(const engine::CheckedPlan& checked) const override;
};

}  // namespace roci::planner::proof
