#include "services/owner/command_ledger.hpp"

#include <algorithm>
#include <set>
#include <utility>

namespace roci::services::owner {

using temporal::Time;

namespace {

bool is_last(const std::optional<CommandStatus>& status) {
  return status && status->stage != Stage::accepted;
}

bool stops(const Request& request) {
  return request.action == Action::execute && request.command == kStopCommand;
}

bool falls_back(const Request& request) {
  return request.action == Action::execute && request.key.activity.starts_with(kFallbackPrefix);
}

// What a commander sends in its own name counts for what is kept of it; an epoch of issue is never later than the
// epoch of who sends, which is checked.
bool counts(const CommandKey& key, const std::string& sender, std::uint64_t epoch) {
  return key.commander == sender && key.issued_epoch != 0 && key.issued_epoch <= epoch;
}

std::string named(const Request& request) {
  return request.command + " (" + request.key.activity + ") of " + request.subsystem;
}

}  // namespace

Reception CommandLedger::receive(const Request& request, Time now) {
  if (stops(request) || falls_back(request)) return execute_for_safety(request, now);
  const EpochStatus epoch_status = epoch_status_of(request);
  const bool asks = request.action == Action::query;
  const bool harmless = epoch_status == EpochStatus::ahead || epoch_status == EpochStatus::unknown;
  if (!asks || !harmless) {
    if (auto refused = refuse(request, epoch_status, now)) return *std::move(refused);
  }
  if (auto old = answer_if_forgotten(request, now)) return {Reception::Order::nothing, std::move(old)};
  switch (request.action) {
    case Action::query:
      return {Reception::Order::nothing, answer(request.key, now)};
    case Action::cancel:
      return cancel(request, now);
    case Action::execute:
      break;
  }
  Reception taken = execute(request, now);
  const bool moves = request.command != kLeadCommand;
  if (moves && taken.order == Reception::Order::carry_out) take_lease(request);
  return taken;
}

void CommandLedger::take_lease(const Request& request) {
  Lease& lease = leases_[{request.robot, request.subsystem}];
  records_.at(request.key).lease_before = std::exchange(lease, {request.sender, request.key});
}

/// A command that was rejected moves nothing, whoever sent it.
void CommandLedger::give_lease_back(const CommandKey& key, const Record& record) {
  const auto lease = leases_.find({record.robot, record.subsystem});
  if (!record.lease_before || lease == leases_.end() || lease->second.by != key) return;
  if (record.lease_before->holder.empty()) {
    leases_.erase(lease);
  } else {
    lease->second = *record.lease_before;
  }
}

CommandLedger::EpochStatus CommandLedger::epoch_status_of(const Request& request) const {
  const auto known = commanders_.find(request.sender);
  if (known == commanders_.end()) {
    if (commanders_.size() >= kCommanders && replaceable().empty()) return EpochStatus::unknown;
    return request.epoch > kEpochJump ? EpochStatus::ahead : EpochStatus::current;
  }
  const Commander& newest = known->second;
  if (request.epoch < newest.epoch) return EpochStatus::stale;
  if (request.epoch - newest.epoch > kEpochJump) return EpochStatus::ahead;
  const bool told = request.incarnation != 0 && newest.incarnation != 0;
  if (request.epoch > newest.epoch || !told) return EpochStatus::current;
  const bool same = request.incarnation == newest.incarnation && request.number > newest.number;
  return same ? EpochStatus::current : EpochStatus::doubled;
}

std::optional<Reception> CommandLedger::refuse(const Request& request, EpochStatus epoch_status,
                                               Time now) const {
  if (epoch_status == EpochStatus::current) return std::nullopt;
  const auto known = commanders_.find(request.sender);
  const std::uint64_t newest = known == commanders_.end() ? 0 : known->second.epoch;
  const std::string epoch = "epoch " + std::to_string(request.epoch);
  Reception out;
  const auto say = [&](std::string code, std::string reason) {
    out.ack = Ack{request.key, {Stage::rejected, std::move(code), std::move(reason)}, now, newest, true};
  };
  if (epoch_status == EpochStatus::stale) {
    say("old-epoch", epoch + " is over; the executive in charge has epoch " + std::to_string(newest));
    return out;
  }
  if (epoch_status == EpochStatus::doubled) {
    say("doubled-epoch", epoch + " was begun by another process; take a later one");
    out.notice = Notice{"commander.doubled", "two processes command as " + request.sender + " in " + epoch +
                                                 "; this one is refused"};
  } else if (epoch_status == EpochStatus::ahead) {
    say("epoch-jump", epoch + " is more than " + std::to_string(kEpochJump) + " after the newest, " +
                          std::to_string(newest) + "; lead in an earlier one first");
    out.notice = Notice{"command.epoch_jump", request.sender + " commands in " + epoch + ", the newest is " +
                                                  std::to_string(newest)};
  } else {
    say("too-many-commanders", std::to_string(kCommanders) + " others have open commands or leases here");
    out.ack->refused_epoch = false;
    out.notice = Notice{"command.foreign", request.sender + " is one commander too many and is refused"};
  }
  return out;
}

void CommandLedger::raise(const Request& request) {
  if (!commanders_.contains(request.sender) && commanders_.size() >= kCommanders) {
    const std::string oldest = replaceable();
    commanders_.erase(oldest);
    retention_.forget(oldest);
  }
  commanders_[request.sender] = {request.epoch, request.incarnation, request.number, ++uses_};
}

/// Returns the commander that has commanded longest ago of those that have neither an open command nor a lease, or "".
std::string CommandLedger::replaceable() const {
  std::set<std::string> needed;
  for (const auto& [key, record] : records_)
    if (!is_last(record.status)) needed.insert(key.commander);
  for (const auto& [subsystem, lease] : leases_) needed.insert(lease.holder);
  const std::pair<const std::string, Commander>* oldest = nullptr;
  for (const auto& one : commanders_)
    if (!needed.contains(one.first) && (oldest == nullptr || one.second.used < oldest->second.used))
      oldest = &one;
  return oldest == nullptr ? "" : oldest->first;
}

Reception CommandLedger::execute(const Request& request, Time now) {
  // Stopping is never refused.
  if (auto old = stops(request) ? std::nullopt : answer_if_forgotten(request, now))
    return {Reception::Order::nothing, std::move(old)};
  const auto [record, is_new] = records_.try_emplace(request.key);
  if (!is_new) {
    if (!record->second.status) return {};  // its status is still to come
    return {Reception::Order::nothing, answer(request.key, now)};
  }
  const bool checked = !stops(request) && !falls_back(request);
  if (checked) raise(request);
  record->second.robot = request.robot;
  record->second.subsystem = request.subsystem;
  record->second.latest_end = request.latest_end;
  record->second.plan = request.plan;
  record->second.counts = checked && counts(request.key, request.sender, request.epoch);
  if (record->second.counts) retention_.taken(request.key, request.plan);
  entries_.push_back({request.key, request.sender, checked ? request.epoch : 0, std::nullopt, request.plan});
  return {Reception::Order::carry_out, std::nullopt};
}

/// Neither takes the lease nor raises the epoch.
Reception CommandLedger::execute_for_safety(const Request& request, Time now) {
  const std::string holder = lease_holder(request.robot, request.subsystem);
  const bool current = epoch_status_of(request) == EpochStatus::current;
  const bool holds = holder.empty() ? current : current && holder == request.sender;
  if (!stops(request) && !holds && !holder.empty()) return refuse_fallback(request, holder, now);
  Reception out = execute(request, now);
  if (holds || out.order != Reception::Order::carry_out) return out;
  out.notice = Notice{
      "command.foreign",
      named(request) + " is taken from " + request.sender + " in epoch " + std::to_string(request.epoch) +
          (holder.empty() ? ", as nobody holds its lease" : "; the lease is held by " + holder)};
  return out;
}

Reception CommandLedger::refuse_fallback(const Request& request, const std::string& holder, Time now) const {
  if (holder == request.sender) return *refuse(request, epoch_status_of(request), now);
  Reception out;
  out.ack =
      Ack{request.key,
          {Stage::rejected, "not-leased", "the lease of " + request.subsystem + " is held by " + holder},
          now};
  out.notice = Notice{"command.foreign", named(request) + " of " + request.sender +
                                             " is refused; the lease is held by " + holder};
  return out;
}

std::uint64_t CommandLedger::newest_epoch(const std::string& commander) const {
  const auto known = commanders_.find(commander);
  return known == commanders_.end() ? 0 : known->second.epoch;
}

Ack CommandLedger::refuse_unleased(const Request& request, std::uint64_t holder_epoch, Time now) const {
  return {request.key,
          {Stage::rejected, "not-leased",
           "the lease of " + request.sender + "'s commands is held in epoch " + std::to_string(holder_epoch)},
          now,
          std::max(holder_epoch, newest_epoch(request.sender)),
          true};
}

void CommandLedger::release(const std::string& commander) {
  std::erase_if(leases_, [&](const auto& lease) { return lease.second.holder == commander; });
  for (auto& [key, record] : records_)
    if (record.lease_before && record.lease_before->holder == commander) record.lease_before->holder.clear();
}

std::string CommandLedger::lease_holder(const std::string& robot, const std::string& subsystem) const {
  const auto lease = leases_.find({robot, subsystem});
  return lease == leases_.end() ? "" : lease->second.holder;
}

void CommandLedger::restore(const LedgerEntry& entry) {
  if (entry.epoch > 0) {
    Commander& commander = commanders_[entry.sender];
    commander.epoch = std::max(commander.epoch, entry.epoch);
    commander.used = ++uses_;
  }
  if (entry.kind == LedgerEntry::Kind::epoch) return;
  if (entry.kind == LedgerEntry::Kind::forgotten) {
    if (commanders_.contains(entry.key.commander))
      retention_.restore(entry.key.commander, {entry.key.issued_epoch, entry.plan});
    return;
  }
  Record& record = records_[entry.key];
  if (entry.status) {
    record.status = entry.status;
  } else {
    record.plan = entry.plan;
    record.counts = counts(entry.key, entry.sender, entry.epoch);
    if (record.counts) retention_.taken(entry.key, entry.plan);
  }
  if (is_last(entry.status)) end(entry.key, record);
}

bool CommandLedger::resume(const Request& request, Time accepted) {
  Record* record = open_record(request.key);
  const auto is_open = [](const auto& one) { return !is_last(one.second.status); };
  if (!record || std::ranges::count_if(records_, is_open) > 1) return false;
  record->robot = request.robot;
  record->subsystem = request.subsystem;
  record->latest_end = request.latest_end;
  record->status = CommandStatus{};
  record->accepted = accepted;
  return true;
}

void CommandLedger::end_restored() {
  for (auto& [key, record] : records_) {
    if (record.status) continue;
    record.status =
        CommandStatus{Stage::failed, "owner-restarted", "its owner was started anew while it ran"};
    retention_.ended(key, record.plan, record.counts);
  }
}

Reception CommandLedger::cancel(const Request& request, Time now) {
  if (Record* record = open_record(request.key)) {
    if (std::exchange(record->cancelling, true)) return {};  // its outcome is still to come
    raise(request);
    return {Reception::Order::break_off, std::nullopt};
  }
  Ack told = answer(request.key, now);
  if (told.status.stage != Stage::unknown) {
    told.status = {Stage::cancel_failed, "already-ended", "it has already ended (" + told.status.code + ")"};
  }
  return {Reception::Order::nothing, std::move(told)};
}

/// The record may be gone then.
void CommandLedger::end(const CommandKey& key, const Record& record) {
  retention_.ended(key, record.plan, record.counts);
  for (const CommandKey& old : retention_.take_due()) records_.erase(old);
}

std::optional<Ack> CommandLedger::answer_if_forgotten(const Request& request, Time now) const {
  if (records_.contains(request.key) || !retention_.forgotten(request.key, request.plan)) return std::nullopt;
  if (request.action == Action::cancel)
    return ack(request.key, {Stage::cancel_failed, "already-ended", "it has ended long ago"}, now);
  return ack(request.key,
             {Stage::failed, "forgotten", "it ended so long ago that its last status is not kept"}, now);
}

std::vector<LedgerEntry> CommandLedger::kept() const {
  std::vector<LedgerEntry> out;
  const auto taken = [&](const CommandKey& key, const Record& record) -> LedgerEntry {
    const bool known = record.counts && commanders_.contains(key.commander);
    return {key, known ? key.commander : "", known ? key.issued_epoch : 0, std::nullopt, record.plan};
  };
  for (const Retention::Ended& one : retention_.ended()) {
    const auto record = records_.find(one.key);
    if (record == records_.end()) continue;
    out.push_back(taken(one.key, record->second));
    out.push_back({one.key, "", 0, record->second.status});
  }
  for (const auto& [key, record] : records_)
    if (!is_last(record.status)) out.push_back(taken(key, record));
  std::vector<const std::pair<const std::string, Commander>*>
      by_use;  // the next process takes them in in this order
  for (const auto& one : commanders_) by_use.push_back(&one);
  std::ranges::sort(by_use, {}, [](const auto* one) { return one->second.used; });
  for (const auto* one : by_use)
    out.push_back(
        {{"", 0, one->first, 0}, one->first, one->second.epoch, std::nullopt, 0, LedgerEntry::Kind::epoch});
  for (const auto& [name, mark] : retention_.forgotten_marks())
    out.push_back({{"", 0, name, mark.epoch}, "", 0, std::nullopt, mark.plan, LedgerEntry::Kind::forgotten});
  return out;
}

CommandLedger::Record* CommandLedger::open_record(const CommandKey& key) {
  const auto found = records_.find(key);
  if (found == records_.end() || is_last(found->second.status)) return nullptr;
  return &found->second;
}

std::optional<Ack> CommandLedger::say(const CommandKey& key, CommandStatus status, Time now) {
  Record* record = open_record(key);
  if (!record || status.stage == Stage::cancel_failed || status.stage == Stage::unknown) return std::nullopt;
  if (!record->status) record->accepted = now;
  if (status.stage == Stage::rejected) give_lease_back(key, *record);
  record->lease_before.reset();
  if (status.stage != Stage::accepted && status.stage != Stage::rejected && !status.results.duration) {
    status.results.duration = now - record->accepted;
  }
  record->status = std::move(status);
  const Ack said = ack(key, *record->status, now);
  if (is_last(record->status)) {
    entries_.push_back({key, "", 0, record->status});
    end(key, *record);
  }
  return said;
}

std::optional<Ack> CommandLedger::refuse_cancel(const CommandKey& key, std::string reason, Time now) {
  Record* record = open_record(key);
  if (!record || !std::exchange(record->cancelling, false)) return std::nullopt;
  return ack(key, {Stage::cancel_failed, "cannot-cancel", std::move(reason)}, now);
}

std::optional<Ack> CommandLedger::repair(const CommandKey& key, std::string reason, Time now) {
  Record* record = open_record(key);
  if (!record || !record->status || (record->latest_end && now >= *record->latest_end)) return std::nullopt;
  record->repaired = true;
  return say(key, {Stage::accepted, "repairing", std::move(reason)}, now);
}

std::optional<Time> CommandLedger::next_overrun() const {
  std::optional<Time> first;
  for (const auto& [key, record] : records_) {
    if (!record.repaired || !record.latest_end || is_last(record.status)) continue;
    if (!first || *record.latest_end < *first) first = record.latest_end;
  }
  if (first) *first += Time{1};
  return first;
}

std::vector<CommandKey> CommandLedger::take_overruns(Time now) {
  std::vector<CommandKey> out;
  for (auto& [key, record] : records_) {
    const bool limited = record.repaired && record.latest_end && !is_last(record.status);
    if (!limited || *record.latest_end >= now) continue;
    record.repaired = false;
    out.push_back(key);
  }
  return out;
}

std::vector<CommandKey> CommandLedger::open(const std::string& robot, const std::string& subsystem) const {
  std::vector<CommandKey> out;
  for (const auto& [key, record] : records_) {
    if (record.robot == robot && record.subsystem == subsystem && !is_last(record.status)) out.push_back(key);
  }
  return out;
}

Ack CommandLedger::answer(const CommandKey& key, Time now) const {
  const auto record = records_.find(key);
  if (record == records_.end()) {
    return ack(key, {Stage::unknown, "unknown-key", "this activity was never commanded here"}, now);
  }
  // What was taken and not yet worded is on its way.
  return ack(key, record->second.status.value_or(CommandStatus{}), now);
}

Ack CommandLedger::ack(const CommandKey& key, CommandStatus status, Time now) const {
  const auto known = commanders_.find(key.commander);
  return {key, std::move(status), now, known == commanders_.end() ? 0 : known->second.epoch};
}

}  // namespace roci::services::owner
