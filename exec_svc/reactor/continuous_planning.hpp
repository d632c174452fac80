// Continuous planning serves an engine that plans all the time (R66, R76-R81): it hears goals, observations
// and steps itself and sends versions of its plan.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "exec_svc/reactor/replanning_policy.hpp"

namespace roci::exec::reactor {

/// Executes what is committed in one version, whatever the next ones say. Conflicts are looked for in all
/// that waits, to the end of the plan: the engine is told, and what is committed stays as it is; if the
/// conflict is about that, the recovery policy follows.
class ContinuousPlanning final : public ReplanningPolicy {
 public:
  explicit ContinuousPlanning(const PolicyParts& parts) : parts_(parts) {}

  void step(temporal::Time now, const ReactorInputs& inputs) override;
  void resume(temporal::Time) override {}  ///< the receipt tells the engine of the restart
  const PlanReceipt* receipt() const override { return &receipt_; }
  void save(archive::Writer& archive) const override;
  void restore(archive::Reader& archive) override;

 private:
  void take_delta(temporal::Time now, const temporal::PlanDelta& delta);
  std::string fault_of(temporal::Time now, const temporal::PlanDelta& delta,
                       temporal::FlexiblePlan& next) const;
  void adopt_version(temporal::Time now, temporal::FlexiblePlan plan);
  void note_planned(const temporal::FlexiblePlan& plan);
  bool end_with_goals(temporal::Time now);
  void monitor(temporal::Time now);
  void check_ahead(temporal::Time now);
  void await_repair(temporal::Time now, const std::string& reason);
  void forget_ended_plan(temporal::Time now);
  bool takes_plans() const;
  bool waits_for_ground() const;
  void report_receipt();

  PolicyParts parts_;
  PlanReceipt receipt_;
  std::optional<PlanReceipt> reported_receipt_;
  std::string conflicting_activity_;           ///< activity of the conflict in the receipt
  temporal::Time repair_deadline_{0};          ///< for the version that repairs a broken plan
  std::vector<std::string> ended_activities_;  ///< of the engine's plan that ended last, sorted
};

}  // namespace roci::exec::reactor
