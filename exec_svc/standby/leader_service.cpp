#include "exec_svc/standby/leader_service.hpp"

#include <utility>

namespace roci::exec::standby {

using journal::Batch;
using journal::Journal;
using journal::Position;
using reactor::Severity;

namespace topics = services::topics;

namespace {

JournalFeed begin_feed(std::uint64_t epoch, Journal& journal) {
  journal.begin_epoch(epoch);
  std::vector<Batch> batches = journal.take_batches();
  JournalFeed feed(epoch, batches.empty() ? journal.position() : batches.front().after);
  for (Batch& batch : batches) feed.add(std::move(batch));
  return feed;
}

}  // namespace

LeaderService::LeaderService(services::Node& node, std::string executive, Lease& lease, Journal& journal,
                             PersistedTermFile& persisted_term, bool told_split)
    : node_(node),
      executive_(std::move(executive)),
      lease_(&lease),
      journal_(&journal),
      persisted_term_(&persisted_term),
      feed_(begin_feed(lease.epoch(), journal)),
      told_split_(told_split),
      messages_(services::advertise(node, topics::exec_member)),
      lease_requests_(services::advertise(node, topics::lease_request)),
      chunks_(services::advertise(node, topics::exec_journal)) {
  services::subscribe(node, topics::exec_member, [this](const v1::LeaseMessage& member) { hear(member); });
  services::subscribe(node, topics::lease_state, [this](const v1::LeaseState& state) { hear(state); });
  services::subscribe(node, topics::goal_hand_over, [this](const v1::GoalHandOver& goal) {
    if (goal.executive() != executive_ || !take_goal_) return;
    if (auto record = from_wire(goal)) take_goal_(*std::move(record));
  });
  node.on_turn([this] { turn(); });
}

void LeaderService::hear(const v1::LeaseMessage& member) {
  if (member.executive() != executive_) return;
  const LeaseMessage message = from_wire(member);
  if (message.member == lease_->self()) return;
  const Moment now = moment();
  lease_->hear(message, now);
  if (message.role == Role::following) feed_.hear(message.has, arrival_of(member), now);
  turn();
}

void LeaderService::hear(const v1::LeaseState& state) {
  if (state.commander() != executive_) return;
  lease_->hear(from_wire(state), moment());
  turn();
}

void LeaderService::turn() {
  const Lease::Turn turn = lease_->turn(feed_.newest(), moment());
  persisted_term_->keep(lease_->persisted_term());
  if (turn.change == Lease::Change::stand_down)
    throw StandDown(turn.reason, lease_->superseded(), told_split_);
  report(turn.change, turn.reason);
  if (turn.speak) {
    messages_.write(to_wire(lease_->message(feed_.newest()), {}, executive_));
    lease_requests_.write(to_wire(lease_->request(), executive_));
  }
  report_leases();
  feed();
  release();
}

void LeaderService::report(Lease::Change change, const std::string& reason) {
  if (change == Lease::Change::alone)
    events_.push_back({Severity::warning, "standby.gone", "no executive stands by: " + reason});
  if (change == Lease::Change::paired)
    events_.push_back({Severity::info, "standby.ready", "an executive stands by: " + reason});
}

// Reports lost leases: then nobody commands, as far as this member knows, since commanding needs the leases
// of all owners.
void LeaderService::report_leases() {
  const auto since = lease_->unleased_since();
  const bool split = since && (told_split_ || moment() - *since >= 2 * lease_->settings().term);
  if (split == told_split_) return;
  told_split_ = split;
  if (!split)
    return events_.push_back(
        {Severity::info, "lead.whole", "holds the leases of all owners, and commands again"});
  const OwnerLeases& leases = lease_->owner_leases();
  events_.push_back({Severity::warning, "lead.split",
                     "commands nothing: the leases of " + leases.missing(lease_->epoch(), moment()) +
                         " are missing" +
                         (leases.other_holds_any(moment()) ? "; the other executive holds some" : "")});
}

goals::AckStage LeaderService::ack_stage() {
  const Position decided = sending_.value_or(feed_.newest());
  if (lease_->held_by_both(decided)) return goals::AckStage::held_by_both;
  told_alone_ = decided;
  return goals::AckStage::journaled;
}

bool LeaderService::take_held() {
  if (!told_alone_ || !lease_->held_by_both(*told_alone_)) return false;
  told_alone_.reset();
  return true;
}

void LeaderService::feed() {
  const auto whole = [this] { return journal_->serialized(); };
  for (const Chunk& chunk : feed_.due(moment(), whole)) chunks_.write(to_wire(chunk, executive_));
}

void LeaderService::send_once_copied(std::function<void()> send, bool commands) {
  for (Batch& batch : journal_->take_batches()) feed_.add(std::move(batch));
  held_.push_back({commands, feed_.newest(), node_.begin_work(), std::move(send)});
  turn();
}

bool LeaderService::waits_for_leases() const {
  const auto since = lease_->unleased_since();
  return !may_command() && (!since || moment() - *since < lease_->settings().term);
}

void LeaderService::release() {
  while (!held_.empty() && lease_->may_send(held_.front().decided, moment())) {
    if (held_.front().commands && waits_for_leases()) return;
    const PendingOutput held = std::move(held_.front());
    held_.pop_front();
    sending_ = held.decided;
    held.send();
    sending_.reset();
    node_.post_work_result(held.work, [] {});
  }
}

void LeaderService::refused(std::uint64_t epoch) {
  lease_->refused(epoch);
  turn();
}

}  // namespace roci::exec::standby
