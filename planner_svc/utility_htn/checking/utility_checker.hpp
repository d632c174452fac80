// This is the independent checker of the utility-driven engine's plan versions, behind the seam.
#pragma once

#include <filesystem>
#include <mutex>
#include <optional>
#include <span>

#include "planner_svc/engine/checker.hpp"
#include "planner_svc/utility_htn/checking/sent_downlinks.hpp"
#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::checking {

/// Reads blocks, times and commitments off a plan's activities, windows and tokens, and has faults() compute everything
/// anew. Which data go with which downlink is no part of a FlexiblePlan; ScheduleChecker looks at that. Remembers
/// downlinks that are over, since what they took of their sol counts when their chains have left the plan.
class UtilityChecker final : public engine::Checker {
 public:
  std::vector<std::string> faults(const engine::CheckedPlan& checked) const override;

 private:
  const model::Network& network(const std::filesystem::path& file) const;

  mutable std::mutex mutex_;
  mutable SentDownlinks sent_;
  mutable std::filesystem::path file_;
  mutable std::optional<model::Network> network_;  // of that file
};

/// Checks a version against a network that is read already. `sent` are downlinks that are over, whether they stand in
/// the plan or not.
std::vector<std::string> faults_of(const model::Network& network, const engine::CheckedPlan& checked,
                                   std::span<const Step> sent = {});

}  // namespace roci::planner::utility_htn::checking
