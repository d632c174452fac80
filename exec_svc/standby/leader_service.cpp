#include "exec_svc/standby/leader_service.hpp"

#include <utility>

#include "exec_svc/standby/standby_wire_service.hpp"

namespace roci::exec::standby {

using journal::Batch;
using journal::Journal;
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
                             PersistedTermFile& persisted_term)
    : node_(node),
      executive_(std::move(executive)),
      lease_(&lease),
      journal_(&journal),
      persisted_term_(&persisted_term),
      feed_(begin_feed(lease.epoch(), journal)),
      messages_(services::advertise(node, topics::exec_member)),
      chunks_(services::advertise(node, topics::exec_journal)) {
  services::subscribe(node, topics::exec_member, [this](const v1::LeaseMessage& member) { hear(member); });
  node.on_turn([this] { turn(); });
}

void LeaderService::hear(const v1::LeaseMessage& member) {
  if (member.executive() != executive_) return;
  const LeaseMessage message = from_wire(member);
  if (message.member == lease_->message({}).member) return;
  const Moment now = moment();
  lease_->hear(message, now);
  if (message.role == Role::following) feed_.hear(message.has, arrival_of(member), now);
  turn();
}

void LeaderService::turn() {
  const Lease::Turn turn = lease_->turn(feed_.newest(), moment());
  persisted_term_->keep(lease_->persisted_term());
  if (turn.change == Lease::Change::stand_down) throw StandDown(turn.reason, lease_->superseded());
  report(turn.change, turn.reason);
  if (turn.speak) messages_.write(to_wire(lease_->message(feed_.newest()), {}, executive_));
  feed();
  release();
}

void LeaderService::report(Lease::Change change, const std::string& reason) {
  if (change == Lease::Change::alone)
    events_.push_back({Severity::warning, "standby.gone", "no executive stands by: " + reason});
  if (change == Lease::Change::paired)
    events_.push_back({Severity::info, "standby.ready", "an executive stands by: " + reason});
}

void LeaderService::feed() {
  const auto whole = [this] { return journal_->serialized(); };
  for (const Chunk& chunk : feed_.due(moment(), whole)) chunks_.write(to_wire(chunk, executive_));
}

void LeaderService::send_once_copied(std::function<void()> send) {
  for (Batch& batch : journal_->take_batches()) feed_.add(std::move(batch));
  held_.push_back({feed_.newest(), node_.begin_work(), std::move(send)});
  turn();
}

void LeaderService::release() {
  while (!held_.empty() && lease_->may_send(held_.front().decided, moment())) {
    const PendingOutput held = std::move(held_.front());
    held_.pop_front();
    held.send();
    node_.post_work_result(held.work, [] {});
  }
}

void LeaderService::refused(std::uint64_t epoch) {
  lease_->refused(epoch);
  turn();
}

}  // namespace roci::exec::standby
