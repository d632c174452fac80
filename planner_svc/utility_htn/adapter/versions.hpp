// This file keeps the version that the executive has, and the one that may be on its way to it (R66, R81).
#pragma once

#include <cstdint>
#include <utility>

#include "planner_svc/engine/stepped_engine.hpp"

namespace roci::planner::utility_htn::adapter {

/// Knows what the next version changes. The host that steps the engine gives it each version that is executed and that
/// it cannot know (StepInputs::executed), so two plans are all that is kept.
class Versions {
 public:
  /// Returns the newest that was sent as long as it may be taken, else the executed one. Version 0: the next
  /// one comes whole.
  const temporal::FlexiblePlan& base() const { return open_ ? sent_ : executed_; }

  void send(temporal::FlexiblePlan plan) {
    sent_ = std::move(plan);
    open_ = true;
  }
  /// Takes in that this version is executed, whoever sent it.
  void resume(const temporal::FlexiblePlan& executed) {
    executed_ = executed;
    sent_ = {};
    open_ = false;
  }
  /// Returns whether the executive had a plan and has none any more; what was to change that is void.
  bool hear(const engine::Receipt& receipt) {
    const bool ended = receipt.version == 0 && executed_.version != 0;
    if (ended) {
      executed_ = {};
      open_ = false;
    } else if (receipt.version != 0 && receipt.version == sent_.version) {
      executed_ = sent_;
      open_ = false;
      refused_in_turn_ = 0;
    }
    if (receipt.refused != 0 && receipt.refused == sent_.version && std::exchange(open_, false))
      ++refused_in_turn_;
    return ended;
  }
  /// Counts the versions that were refused since one was taken: what they would have changed is not in force.
  std::uint32_t refused_in_turn() const { return refused_in_turn_; }
  /// Takes in that nobody has answered for so long that the newest version counts as lost. Returns whether there
  /// was one.
  bool give_up() { return std::exchange(open_, false); }

 private:
  temporal::FlexiblePlan sent_;
  temporal::FlexiblePlan executed_;
  std::uint32_t refused_in_turn_ = 0;
  bool open_ = false;  // sent, and neither taken nor refused nor given up
};

}  // namespace roci::planner::utility_htn::adapter
