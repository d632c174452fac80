#include "exec_svc/standby/following_service.hpp"

#include <algorithm>

#include "exec_svc/standby/standby_wire_service.hpp"
#include "exec_svc/wire_service.hpp"

namespace roci::exec::standby {

using goals::GoalRecord;
using goals::GoalState;
using journal::Journal;

namespace topics = services::topics;

FollowingService::FollowingService(services::Node& node, Lease& lease, Journal& journal,
                                   StandingFile& standing)
    : node_(node),
      lease_(&lease),
      journal_(&journal),
      standing_(&standing),
      copy_(journal),
      words_(services::advertise(node, topics::exec_member)),
      goals_(services::advertise(node, topics::goal)) {
  services::subscribe(node, topics::exec_member, [this](const v1::ExecMember& member) { hear(member); });
  services::subscribe(node, topics::exec_journal,
                      [this](const v1::JournalParcel& parcel) { take(from_wire(parcel)); });
  services::subscribe(node, topics::clock_step, [this](const v1::ClockStep& step) {
    over_ = over_ || step.last();
    if (over_) node_.stop();
  });
  node.on_turn([this] { turn(); });
}

void FollowingService::hear(const v1::ExecMember& member) {
  lease_->hear(from_wire(member), moment());
  turn();
}

void FollowingService::take(const Parcel& parcel) {
  if (lead_) return;
  const bool completes = parcel.parts > 0 && parcel.part + 1 == parcel.parts;
  const std::vector<GoalRecord> earlier = completes ? journal_->goals() : std::vector<GoalRecord>{};
  const JournalCopy::Taken taken = copy_.take(parcel, lease_->epoch());
  if (taken == JournalCopy::Taken::old || taken == JournalCopy::Taken::corrupt) return;
  lease_->hear_leader(parcel.leader, moment());
  if (taken == JournalCopy::Taken::whole) ask_again(earlier);
  if (taken != JournalCopy::Taken::known) say();
}

// Goals that this member took in while it led alone, and that the leader never heard of.
void FollowingService::ask_again(const std::vector<GoalRecord>& earlier) {
  const std::vector<GoalRecord> goals = journal_->goals();
  for (const GoalRecord& goal : earlier) {
    const bool open = goal.state == GoalState::pending || goal.state == GoalState::planned;
    const bool known = std::ranges::any_of(
        goals, [&](const GoalRecord& other) { return other.request.key == goal.request.key; });
    if (open && !known) goals_.write(exec::to_wire(goal.request));
  }
}

void FollowingService::turn() {
  if (lead_) return;
  const Lease::Turn turn = lease_->turn(copy_.has(), moment());
  standing_->keep(lease_->standing());
  if (turn.speak) say();
  if (turn.change != Lease::Change::lead) return;
  lead_ = turn;
  node_.stop();
}

void FollowingService::say() { words_.write(to_wire(lease_->word(copy_.has()), copy_.arrival())); }

}  // namespace roci::exec::standby
