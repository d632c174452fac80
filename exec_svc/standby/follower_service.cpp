#include "exec_svc/standby/follower_service.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

#include "exec_svc/standby/standby_wire_service.hpp"
#include "services/log/log.hpp"
#include "services/node/make_event.hpp"

namespace roci::exec::standby {

using goals::GoalRecord;
using journal::Journal;

namespace topics = services::topics;

namespace {

constexpr Moment kHandOverAgain = std::chrono::seconds(1);
// Bounds the time in which givers of orders that are still there repeat them to the leader.
constexpr Moment kOrdersHeard = std::chrono::seconds(5);
constexpr std::size_t kToldOrders = 20;  // one by one
constexpr std::size_t kToldToLack = 64;  // lines of the log, for one follower

}  // namespace

FollowerService::FollowerService(services::Node& node, std::string executive, Lease& lease, Journal& journal,
                                 PersistedTermFile& persisted_term, GoalsApart apart)
    : node_(node),
      executive_(std::move(executive)),
      lease_(&lease),
      journal_(&journal),
      persisted_term_(&persisted_term),
      copy_(journal,
            [this] {
              apart_.keep(*journal_);
              std::ranges::move(taken_orders(*journal_), std::back_inserter(apart_orders_));
            }),
      apart_(std::move(apart)),
      handed_over_(apart_.goals()),
      messages_(services::advertise(node, topics::exec_member)),
      lease_requests_(services::advertise(node, topics::lease_request)),
      goals_(services::advertise(node, topics::goal_hand_over)),
      events_(services::advertise(node, topics::event)) {
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
  if (taken == JournalCopy::Result::excess) tell_excess(chunk);
  if (taken == JournalCopy::Result::unwritten) tell_unwritten();
  lease_->hear_leader(chunk.leader, moment());
  if (taken == JournalCopy::Result::whole) {
    handed_over_ = apart_.goals();
    orders_replaced_at_ = moment();
  }
  if (taken != JournalCopy::Result::known) say();
}

// It is asked for anew by what say() tells that this member has.
void FollowerService::tell_excess(const Chunk& chunk) {
  const std::uint64_t times = refusals_.note("copy");
  if (times == 0) return;
  const std::string text = "a whole journal of " + std::to_string(chunk.parts) + " parts, one of " +
                           std::to_string(chunk.bytes.size()) + " bytes, is refused: there is room for " +
                           std::to_string(kJournalCopyBytes >> 20) + " MiB in parts of " +
                           std::to_string(kPartBytes >> 10) + " KiB, as many as were announced (" +
                           std::to_string(times) +
                           " so far); until another one comes the standby cannot take over";
  services::log::warning(text);
  events_.write(services::node::make_event(v1::SEVERITY_WARNING, "journal.no_room", text));
}

void FollowerService::tell_unwritten() {
  const std::uint64_t times = refusals_.note("disk");
  if (times == 0) return;
  const std::string text =
      "the standby's disk does not take the leader's journal or the goals of its own, which stays (" +
      std::to_string(times) + " times so far); make room on the disk";
  services::log::error(text);
  events_.write(services::node::make_event(v1::SEVERITY_ERROR, "journal.waiting", text));
}

// Until the copy of the leader's journal shows that it has them.
void FollowerService::hand_over() {
  for (const std::string& damage : apart_.take_damage()) {
    services::log::error(damage);
    events_.write(services::node::make_event(v1::SEVERITY_ERROR, "journal.damaged", damage));
  }
  const bool nothing_to_do = handed_over_.empty() && !apart_.waits_for_disk();
  if (nothing_to_do || moment() - handed_over_at_ < kHandOverAgain) return;
  handed_over_at_ = moment();
  if (apart_.waits_for_disk()) handed_over_ = apart_.goals();
  handed_over_ = GoalsApart::missing(handed_over_, journal_->goals());
  if (handed_over_.empty()) return apart_.remove();
  for (const GoalRecord& goal : handed_over_) goals_.write(to_wire(goal, executive_, lease_->self()));
}

// Reports orders that the leader lacks; they are not merged (orders_apart.hpp).
void FollowerService::tell_lost_orders() {
  if (apart_orders_.empty() || (!lead_ && moment() - orders_replaced_at_ < kOrdersHeard)) return;
  const auto lost = unknown_orders(std::exchange(apart_orders_, {}), *journal_);
  const auto tell = [this](const std::string& text) {
    services::log::warning(text);
    events_.write(services::node::make_event(v1::SEVERITY_WARNING, "order.lost", text));
  };
  for (std::size_t i = 0; i < std::min(lost.size(), kToldOrders); ++i)
    tell(
        "order " + lost[i].key + " (" + lost[i].what +
        ") was taken by an executive that has been replaced since, " +
        "and the one that leads has not heard of it: it is not in force; give it again if it is still meant");
  if (lost.size() > kToldOrders)
    tell(std::to_string(lost.size() - kToldOrders) + " more orders are not in force for the same reason");
}

void FollowerService::turn() {
  if (lead_) return;
  const Lease::Turn turn = lease_->turn(copy_.has(), moment());
  persisted_term_->keep(lease_->persisted_term());
  if (turn.speak) say();
  tell_what_it_lacks(turn);
  hand_over();
  if (turn.change == Lease::Change::lead) lead_ = turn;
  tell_lost_orders();
  if (!lead_) return;
  node_.stop();
}

// Reports missing leases once for the same owners: a member that holds a part gives it back and asks again
// for as long as the others are away.
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
