// Reactor: after a restart. Its state comes from a snapshot and the inputs since; what was on its way to
// owners and planner is asked for again.
#include "exec_svc/archive/fields.hpp"
#include "exec_svc/reactor/reactor.hpp"

namespace roci::exec::reactor {

using archive::Reader;
using archive::Writer;
using executive::Inputs;
using executive::OutcomeKind;
using goals::GoalRecord;

void Reactor::resume(temporal::Time now) {
  report(Severity::info, "executive.resumed",
         std::string("goes on where it was: ") + to_string(phase_) +
             (phase_ == MissionPhase::executing ? " plan " + std::to_string(plan_version_) : ""));
  forward(executive_.resume(now));
  call_open_ = false;  // nobody waits for the old answer
  if (phase_ == MissionPhase::planning && !replan_wanted_) begin_planning(now);
  if (phase_ == MissionPhase::planning && replan_wanted_) phase_ = MissionPhase::idle;
  if (background_replan_ && !background_replan_->reply) {
    call_.id = ++call_id_;
    call_open_ = true;
    call_cancelled_ = false;
    out_.call = call_;
  }
  fallbacks_sent_ = false;
  if (phase_ == MissionPhase::safe && !beliefs_.active().empty()) send_fallbacks();
}

bool Reactor::at_rest() const {
  const OutcomeKind kind = executive_.outcome().kind;
  return phase_ != MissionPhase::executing &&
         (kind == OutcomeKind::idle || kind == OutcomeKind::finished || kind == OutcomeKind::cancelled);
}

template <class Archive, class Self>
void Reactor::fields(Archive& a, Self& self) {
  a(self.phase_, self.replan_wanted_, self.replan_reason_, self.first_plan_, self.plan_version_,
    self.call_id_, self.call_, self.call_open_, self.call_cancelled_, self.plan_invalid_);
  a(self.counts_, self.models_, self.models_changed_, self.stale_calls_, self.pause_deadline_);
  a(self.fallback_round_, self.fallbacks_sent_, self.failed_calls_, self.next_call_at_,
    self.reported_starts_);
  a(self.condition_values_, self.reserves_, self.soft_goals_left_out_);
  a(self.receipt_, self.reported_receipt_, self.repair_deadline_, self.ended_);
}

std::string Reactor::snapshot() const {
  Writer writer;
  fields(writer, *this);
  std::vector<GoalRecord> goals;
  for (const GoalRecord* record : goals_.all()) goals.push_back(*record);
  writer(goals, beliefs_.values(), beliefs_.assumed(), failure_backoff_.in_a_row(), remaining());
  return writer.take();
}

void Reactor::restore(std::string_view snapshot) {
  Reader reader(snapshot);
  fields(reader, *this);
  std::vector<GoalRecord> goals;
  std::map<std::string, temporal::Value> values;
  std::map<std::string, std::vector<std::string>> assumed;
  std::map<std::string, std::uint32_t> in_a_row;
  reader(goals, values, assumed, in_a_row, planned_);
  reader.finish();
  for (const GoalRecord& record : goals) goals_.restore(record);
  Inputs observed;
  for (auto& [timeline, value] : values) {
    beliefs_.observe(timeline, value);
    observed.observations.push_back({timeline, value});
  }
  executive_.step(temporal::Time{0}, observed);
  for (auto& [timeline, facts] : assumed) beliefs_.assume(timeline, std::move(facts));
  failure_backoff_.restore(std::move(in_a_row));
}

}  // namespace roci::exec::reactor
