#include "exec_svc/standby/follower_service.hpp"

#include <algorithm>

#include "exec_svc/standby/standby_wire_service.hpp"

namespace roci::exec::standby {

using goals::GoalRecord;
using goals::GoalState;
using journal::Journal;

namespace topics = services::topics;

FollowerService::FollowerService(services::Node& node, std::string executive, Lease& lease, Journal& journal,
                                 PersistedTermFile& persisted_term, TellGoal tell_goal)
    : node_(node),
      executive_(std::move(executive)),
      lease_(&lease),
      journal_(&journal),
      persisted_term_(&persisted_term),
      copy_(journal),
      messages_(services::advertise(node, topics::exec_member)),
      tell_goal_(std::move(tell_goal)) {
  services::subscribe(node, topics::exec_member, [this](const v1::LeaseMessage& member) { hear(member); });
  services::subscribe(node, topics::exec_journal, [this](const v1::JournalChunk& chunk) {
    if (chunk.executive() == executive_) take(from_wire(chunk));
  });
  services::subscribe(node, topics::clock_step, [this](const v1::ClockStep& step) {
    over_ = over_ || step.last();
    if (over_) node_.stop();
  });
  node.on_turn([this] { turn(); });
}

void FollowerService::hear(const v1::LeaseMessage& member) {
  if (member.executive() != executive_) return;
  lease_->hear(from_wire(member), moment());
  turn();
}

void FollowerService::take(const Chunk& chunk) {
  if (lead_) return;
  const bool completes = chunk.parts > 0 && chunk.part + 1 == chunk.parts;
  const std::vector<GoalRecord> earlier = completes ? journal_->goals() : std::vector<GoalRecord>{};
  const JournalCopy::Result taken = copy_.take(chunk, lease_->epoch());
  if (taken == JournalCopy::Result::old || taken == JournalCopy::Result::corrupt) return;
  lease_->hear_leader(chunk.leader, moment());
  if (taken == JournalCopy::Result::whole) ask_again(earlier);
  if (taken != JournalCopy::Result::known) say();
}

// Asks again for goals that this member took in while it led alone, and that the leader never heard of.
void FollowerService::ask_again(const std::vector<GoalRecord>& earlier) {
  const std::vector<GoalRecord> goals = journal_->goals();
  for (const GoalRecord& goal : earlier) {
    const bool open = goal.state == GoalState::pending || goal.state == GoalState::planned;
    const bool known = std::ranges::any_of(
        goals, [&](const GoalRecord& other) { return other.request.key == goal.request.key; });
    if (open && !known) tell_goal_(goal.request);
  }
}

void FollowerService::turn() {
  if (lead_) return;
  const Lease::Turn turn = lease_->turn(copy_.has(), moment());
  persisted_term_->keep(lease_->persisted_term());
  if (turn.speak) say();
  if (turn.change != Lease::Change::lead) return;
  lead_ = turn;
  node_.stop();
}

void FollowerService::say() {
  messages_.write(to_wire(lease_->message(copy_.has()), copy_.arrival(), executive_));
}

}  // namespace roci::exec::standby
