// Measurements are what executed activities took and brought: the executive tells when they ended, the owners
// of their commands the rest (R76, R101, R116).
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"
#include "planner_svc/utility_htn/assessor/learning.hpp"

namespace roci::planner::utility_htn::adapter {

/// Joins what executive and owners say of an activity, in either order, and gives each measurement out once.
class Measurements {
 public:
  struct Measurement {
    model::TaskIndex task = 0;
    assessor::Measured measured;
  };

  /// Take in what was heard; only what has succeeded counts.
  void hear(const engine::StepStatus& step);
  void hear(const engine::CommandResult& result);
  /// Takes in that the measurements of these activities stand in the values already: another process took
  /// them.
  void resume(std::set<std::string> taken) { taken_ = std::move(taken); }
  /// Returns what can be learned by now: a duration at its activity's end, energy, power and values when the results of
  /// all commands are there. Of an activity that was tried again neither duration nor power is known: the executive
  /// tells when it began first.
  std::vector<Measurement> take(const model::Network& network);
  /// Forgets all other activities.
  void keep_only(const std::function<bool(const std::string&)>& is_kept);
  /// Returns the activities of which everything was given out.
  const std::set<std::string>& taken() const { return taken_; }

 private:
  struct Heard {
    std::optional<temporal::Duration> took{};  // it has succeeded
    std::uint32_t attempt = 0;                 // with which it did; 0: not known
    bool duration_taken = false;
    std::map<std::uint32_t, engine::CommandResult> results{};  // by attempt
    std::uint32_t last_attempt() const;
  };
  static std::optional<assessor::Measured> measured(const Heard& heard, std::size_t commands);

  std::map<std::string, Heard> heard_;  // by activity
  std::set<std::string> taken_;
};

}  // namespace roci::planner::utility_htn::adapter
