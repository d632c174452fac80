#include "exec_svc/standby/leading_service.hpp"

#include <utility>

#include "exec_svc/standby/standby_wire_service.hpp"

namespace roci::exec::standby {

using journal::Batch;
using journal::Journal;
using reactor::NoteLevel;

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

LeadingService::LeadingService(services::Node& node, Lease& lease, Journal& journal, StandingFile& standing)
    : node_(node),
      lease_(&lease),
      journal_(&journal),
      standing_(&standing),
      feed_(begin_feed(lease.epoch(), journal)),
      words_(services::advertise(node, topics::exec_member)),
      parcels_(services::advertise(node, topics::exec_journal)) {
  services::subscribe(node, topics::exec_member, [this](const v1::ExecMember& member) { hear(member); });
  node.on_turn([this] { turn(); });
}

void LeadingService::hear(const v1::ExecMember& member) {
  const Word word = from_wire(member);
  if (word.member == lease_->word({}).member) return;
  const Moment now = moment();
  lease_->hear(word, now);
  if (word.role == Role::following) feed_.hear(word.has, arrival_of(member), now);
  turn();
}

void LeadingService::turn() {
  const Lease::Turn turn = lease_->turn(feed_.newest(), moment());
  standing_->keep(lease_->standing());
  if (turn.change == Lease::Change::stand_down) throw StandDown(turn.why, lease_->superseded());
  note(turn.change, turn.why);
  if (turn.speak) words_.write(to_wire(lease_->word(feed_.newest()), {}));
  feed();
  let_out();
}

void LeadingService::note(Lease::Change change, const std::string& why) {
  if (change == Lease::Change::alone)
    notes_.push_back({NoteLevel::warning, "standby.gone", "no executive stands by: " + why});
  if (change == Lease::Change::paired)
    notes_.push_back({NoteLevel::info, "standby.ready", "an executive stands by: " + why});
}

void LeadingService::feed() {
  const auto whole = [this] { return journal_->whole(); };
  for (const Parcel& parcel : feed_.due(moment(), whole)) parcels_.write(to_wire(parcel));
}

void LeadingService::hold(std::function<void()> send) {
  for (Batch& batch : journal_->take_batches()) feed_.add(std::move(batch));
  held_.push_back({feed_.newest(), node_.begin_work(), std::move(send)});
  turn();
}

void LeadingService::let_out() {
  while (!held_.empty() && lease_->may_send(held_.front().decided, moment())) {
    const Held held = std::move(held_.front());
    held_.pop_front();
    held.send();
    node_.post_work_result(held.work, [] {});
  }
}

void LeadingService::refused() {
  lease_->refused();
  turn();
}

}  // namespace roci::exec::standby
