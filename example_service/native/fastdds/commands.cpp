#include "commands.hpp"

#include <utility>
#include <vector>

#include "commandPubSubTypes.h"

namespace borehole {
namespace {

constexpr std::uint64_t kEpochJump = 1000;

CommandKey key_of(const v1::Command& request) {
  return {request.commander(), request.epoch(), request.activity(), request.attempt()};
}

bool is_open(const CommandStatus& status) { return status.stage == v1::STAGE_ACCEPTED; }

}  // namespace

Commands::Commands(Clock& clock, const std::string& owner, Driver& driver)
    : clock_(clock),
      owner_(owner),
      driver_(driver),
      acks_(clock.advertise<v1::CommandAckPubSubType>("roci/command/ack", Durability::state)) {
  clock.read<v1::CommandPubSubType, v1::Command>("roci/command", Durability::request,
                                                 [this](const v1::Command& request) { receive(request); });
}

void Commands::acknowledge(const CommandKey& key, const CommandStatus& status, std::uint64_t newest,
                           bool refused_epoch) {
  v1::CommandAck ack;
  ack.commander(std::get<0>(key));
  ack.epoch(std::get<1>(key));
  ack.activity(std::get<2>(key));
  ack.attempt(std::get<3>(key));
  ack.stage(status.stage);
  ack.owner(owner_);
  ack.code(status.code);
  ack.reason(status.reason);
  ack.outcome().duration_us(status.duration_us);
  ack.outcome().energy_j(status.energy_j);
  ack.newest_epoch(newest);
  ack.refused_epoch(refused_epoch);
  clock_.write(acks_, ack);
}

std::uint64_t Commands::newest_epoch(const std::string& commander) const {
  const auto known = commanders_.find(commander);
  return known == commanders_.end() ? 0 : known->second.epoch;
}

void Commands::tell(const CommandKey& key) {
  acknowledge(key, records_.at(key).status, newest_epoch(std::get<0>(key)));
}

void Commands::say(const CommandKey& key, CommandStatus status) {
  Record& record = records_.at(key);
  if (!is_open(record.status)) return;  // the last status stays
  if (record.accepted_us < 0) record.accepted_us = clock_.now_us();
  if (!is_open(status) && status.stage != v1::STAGE_REJECTED)
    status.duration_us = clock_.now_us() - record.accepted_us;
  record.status = std::move(status);
  tell(key);
}

bool Commands::repair(const CommandKey& key, const std::string& reason) {
  Record& record = records_.at(key);
  if (record.latest_end_us >= 0 && clock_.now_us() >= record.latest_end_us) return false;
  record.repaired = true;
  say(key, {v1::STAGE_ACCEPTED, "repairing", reason});
  return true;
}

std::optional<std::int64_t> Commands::next_overrun_us() const {
  std::optional<std::int64_t> first;
  for (const auto& [key, record] : records_)
    if (is_open(record.status) && record.repaired && record.latest_end_us >= 0)
      first = std::min(first.value_or(record.latest_end_us), record.latest_end_us);
  return first;
}

void Commands::overrun() {
  std::vector<CommandKey> over;
  for (const auto& [key, record] : records_)
    if (is_open(record.status) && record.repaired && record.latest_end_us >= 0 &&
        record.latest_end_us <= clock_.now_us())
      over.push_back(key);
  for (const CommandKey& key : over)
    driver_.break_off(key,
                      {v1::STAGE_FAILED, "repair-overrun", "the step's time was over before the repair was"});
}

// The epoch of who sends: refused, and told the newest, is one that is over,
// one that another process has begun, one far ahead.
bool Commands::refused(const v1::Command& request) {
  const auto known = commanders_.find(request.header().sender());
  const std::uint64_t newest = newest_epoch(request.header().sender()), epoch = request.sender_epoch();
  const std::string text = "epoch " + std::to_string(epoch);
  CommandStatus status{v1::STAGE_REJECTED};
  if (epoch < newest) {
    status.code = "old-epoch";
    status.reason = text + " is over; the executive in charge has epoch " + std::to_string(newest);
  } else if (epoch - newest > kEpochJump && request.action() != v1::COMMAND_QUERY) {
    status.code = "epoch-jump";
    status.reason = text + " is more than " + std::to_string(kEpochJump) + " after the newest, " +
                    std::to_string(newest) + "; lead in an earlier one first";
  } else if (known != commanders_.end() && epoch == newest &&
             (request.header().incarnation() != known->second.incarnation ||
              request.header().seq() <= known->second.seq)) {
    status.code = "doubled-epoch";
    status.reason = text + " was begun by another process; take a later one";
  }
  if (!status.code.empty()) acknowledge(key_of(request), status, newest, true);
  return !status.code.empty();
}

void Commands::raise_epoch(const v1::Command& request) {
  commanders_[request.header().sender()] = {request.sender_epoch(), request.header().incarnation(),
                                            request.header().seq()};
}

Commands::Record& Commands::take(const v1::Command& request, const CommandKey& key) {
  Record& record = records_[key];
  record.robot = request.robot();
  record.subsystem = request.subsystem();
  record.latest_end_us = request.latest_end_us();
  return record;
}

void Commands::stop(const v1::Command& request, const CommandKey& key) {
  std::vector<CommandKey> open;
  for (const auto& [other, record] : records_)
    if (is_open(record.status) && record.robot == request.robot() && record.subsystem == request.subsystem())
      open.push_back(other);
  take(request, key);
  for (const CommandKey& other : open)
    driver_.break_off(other, {v1::STAGE_CANCELLED, "stopped", "stopped by " + request.activity()});
  say(key, {v1::STAGE_COMPLETED, "done", ""});
}

void Commands::cancel(const v1::Command& request, const CommandKey& key) {
  const auto known = records_.find(key);
  const std::uint64_t newest = newest_epoch(request.commander());
  if (known == records_.end())
    return acknowledge(key, {v1::STAGE_UNKNOWN, "unknown-key", "this activity was never commanded here"},
                       newest);
  if (!is_open(known->second.status))
    return acknowledge(key,
                       {v1::STAGE_CANCEL_FAILED, "already-ended",
                        "it has already ended (" + known->second.status.code + ")"},
                       newest);
  if (std::exchange(known->second.cancelling, true)) return;  // its outcome is still to come
  raise_epoch(request);
  driver_.break_off(key, {v1::STAGE_CANCELLED, "cancelled", "cancelled on request"});
}

void Commands::receive(const v1::Command& request) {
  if (request.owner() != owner_) return;
  const CommandKey key = key_of(request);
  const bool executes = request.action() == v1::COMMAND_EXECUTE;
  const bool stops = executes && request.command_name() == "stop";
  if (!stops && refused(request)) return;  // a stop is never refused
  if (request.action() == v1::COMMAND_CANCEL) return cancel(request, key);
  if (records_.contains(key)) return tell(key);  // a repeated command, or a query
  if (!executes)
    return acknowledge(key, {v1::STAGE_UNKNOWN, "unknown-key", "this activity was never commanded here"},
                       newest_epoch(request.commander()));
  if (stops) return stop(request, key);
  raise_epoch(request);
  take(request, key);
  if (request.command_name() == "lead") return say(key, {v1::STAGE_COMPLETED, "done", ""});
  driver_.carry_out(key, request);
}

}  // namespace borehole
