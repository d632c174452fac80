#include "exec_svc/standby/follower_service.hpp"

#include <algorithm>

#include "exec_svc/standby/standby_wire_service.hpp"
#include "services/log/log.hpp"

namespace roci::exec::standby {

using goals::GoalRecord;
using journal::Journal;

namespace topics = services::topics;

namespace {

constexpr Moment kHandOverAgain = std::chrono::seconds(1);
constexpr std::size_t kToldToLack = 64;  // lines of the log, for one follower

}  // namespace

FollowerService::FollowerService(services::Node& node, std::string executive, Lease& lease, Journal& journal,
                                 PersistedTermFile& persisted_term, GoalsApart apart)
    : node_(node),
      executive_(std::move(executive)),
      lease_(&lease),
      journal_(&journal),
      persisted_term_(&persisted_term),
      copy_(journal, [this] { apart_.keep(*journal_); }),
      apart_(std::move(apart)),
      handed_over_(apart_.goals()),
      messages_(services::advertise(node, topics::exec_member)),
      lease_requests_(services::advertise(node, topics::lease_request)),
      goals_(services::advertise(node, topics::goal_hand_over)) {
  services::subscribe(node, topics::exec_member, [this](const v1::LeaseMessage& member) { hear(member); });
  services::subscribe(node, topics::lease_state, [this](const v1::LeaseState& state) { hear(state); });
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

void FollowerService::hear(const v1::LeaseState& state) {
  if (state.commander() != executive_) return;
  lease_->hear(from_wire(state), moment());
  turn();
}

void FollowerService::take(const Chunk& chunk) {
  if (lead_) return;
  const JournalCopy::Result taken = copy_.take(chunk, lease_->epoch());
  if (taken == JournalCopy::Result::old || taken == JournalCopy::Result::corrupt) return;
  lease_->hear_leader(chunk.leader, moment());
  if (taken == JournalCopy::Result::whole) handed_over_ = apart_.goals();
  if (taken != JournalCopy::Result::known) say();
}

// Until the copy of the leader's journal shows that it has them.
void FollowerService::hand_over() {
  if (handed_over_.empty() || moment() - handed_over_at_ < kHandOverAgain) return;
  handed_over_at_ = moment();
  handed_over_ = GoalsApart::missing(handed_over_, journal_->goals());
  if (handed_over_.empty()) return apart_.remove();
  for (const GoalRecord& goal : handed_over_)
    goals_.write(to_wire(goal, executive_, lease_->request().member));
}

void FollowerService::turn() {
  if (lead_) return;
  const Lease::Turn turn = lease_->turn(copy_.has(), moment());
  persisted_term_->keep(lease_->persisted_term());
  if (turn.speak) say();
  tell_what_it_lacks(turn);
  hand_over();
  if (turn.change != Lease::Change::lead) return;
  lead_ = turn;
  node_.stop();
}

// Once for the same owners: who has a part gives it back and asks again, for as long as the others are away.
void FollowerService::tell_what_it_lacks(const Lease::Turn& turn) {
  const std::string lacks = turn.lacks + (turn.doubtful ? " in doubt" : "");
  if (turn.lacks.empty() || told_to_lack_.size() >= kToldToLack || !told_to_lack_.insert(lacks).second)
    return;
  services::log::info(executive_ + " would lead, since " + turn.reason +
                      ", and does not: it lacks the leases of " + turn.lacks);
}

void FollowerService::say() {
  messages_.write(to_wire(lease_->message(copy_.has()), copy_.arrival(), executive_));
  lease_requests_.write(to_wire(lease_->request(), executive_));
}

}  // namespace roci::exec::standby
