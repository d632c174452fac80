// Background replanning (`replanning: situated`) lets what runs go on while the planner works.
#pragma once

#include <optional>

#include "exec_svc/reactor/replanning_policy.hpp"
#include "exec_svc/reactor/stop_and_replan.hpp"

namespace roci::exec::reactor {

/// Plans from the state that the running activities will leave, while nothing else starts. The plans change
/// when those activities have ended, if that state has come about. Where the old plan must not go on, the
/// robot stops as under StopAndReplan.
class BackgroundReplan final : public ReplanningPolicy {
 public:
  explicit BackgroundReplan(const PolicyParts& parts) : parts_(parts), stop_(parts) {}

  void step(temporal::Time now, const ReactorInputs& inputs) override;
  void resume(temporal::Time now) override;
  void save(archive::Writer& archive) const override { stop_.save(archive); }
  void restore(archive::Reader& archive) override { stop_.restore(archive); }

 private:
  /// Holds a planner call during which what runs goes on. It exists only while a plan is executed.
  struct Call {
    problem::Forecast forecast;  ///< state that the running activities leave
    std::optional<PlanReply> reply;
    std::optional<temporal::Time> observed_by;  ///< time until which that state may still be observed
  };

  bool possible() const;
  bool may_begin_after_recall() const;
  void grant(temporal::Time now);
  void call_planner(temporal::Time now);
  void proceed(temporal::Time now);
  void act_on_failure(temporal::Time now, const PlanReply& reply);
  void keep_plan(temporal::Time now);
  void await_retry(temporal::Time now);
  void change_plans(temporal::Time now);

  PolicyParts parts_;
  StopAndReplan stop_;
  std::optional<Call> call_;
  /// Says, only while a plan is executed, that the planner is to be asked again at PlannerCall::not_before; the
  /// plan goes on until then.
  bool retry_ = false;
};

}  // namespace roci::exec::reactor
