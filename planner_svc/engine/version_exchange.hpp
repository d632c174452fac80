// The version exchange is what engine and executive know of each other's versions, with messages between them
// that come late, twice or not at all (R66, R81).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/engine/plan_history.hpp"
#include "planner_svc/engine/stepped_engine.hpp"

namespace roci::planner::engine {

/// Stands between an engine that plans all the time and what is heard of the executive. It sees to it that the engine
/// goes on from the version that is executed: one that is neither the newest that this engine sent nor known to it
/// already is given to it whole.
class VersionExchange {
 public:
  /// Bounds the numbers that others are believed to have reached: with a version every second it takes a hundred years
  /// to get there. A liar cannot use the numbers up, behind which no version could follow.
  static constexpr std::uint32_t kHighestTold = 4'000'000'000;

  /// Takes in a plan that the executive reports. Returns whether it is news: unknown, and not older than the newest
  /// receipt. It may have the number of a plan that was sent here and yet be another one, sent by a process that died.
  bool take(const temporal::FlexiblePlan& executed);
  /// Takes in that somebody says that this number was used.
  void note(std::uint32_t version);
  /// Leaves out a receipt of a version that cannot be.
  void hear(const Receipt& receipt);

  /// Returns whether the engine has something to hear of this. A refusal by its own checker is not news,
  /// since it would make the engine try again and again.
  bool has_news() const;
  /// Fills in receipt, executed version and highest number, and takes them as heard.
  void give(StepInputs& inputs);
  /// Takes in that the engine is a new one, which knows nothing.
  void engine_is_new();

  /// Fills `next` with the plan that the delta makes. Returns what is wrong with it, empty if nothing is.
  std::string apply(const temporal::PlanDelta& delta, temporal::FlexiblePlan& next) const;
  void sent(temporal::FlexiblePlan plan);
  /// Takes in that the engine's checker has refused this version; the engine hears it with its next step.
  void refuse(std::uint32_t version, const std::string& reason);

  /// Returns the version that is executed by the newest receipt, or null if there is none or it is not known
  /// yet.
  const temporal::FlexiblePlan* executed() const;
  const temporal::FlexiblePlan* version(std::uint32_t number) const { return history_.version(number); }
  const std::optional<Receipt>& receipt() const { return newest_; }
  std::uint32_t last_version() const { return last_version_; }

 private:
  bool is_of_use() const;
  bool is_possible(std::uint32_t version) const { return version <= kHighestTold || version <= last_version_; }
  void use(std::uint32_t version);

  PlanHistory history_;
  std::optional<Receipt> newest_;
  std::optional<Receipt> refused_;  // by the checker: version and reason
  bool owes_ = false;               // the engine knows nothing of the executed version
  std::uint32_t last_executed_ = 0;
  bool due_ = false;  // the receipt was not given yet
  std::uint32_t last_version_ = 0;
  std::uint32_t engine_has_ = 0;   // executed, as the engine knows
  std::uint32_t engine_sent_ = 0;  // its newest
};

}  // namespace roci::planner::engine
