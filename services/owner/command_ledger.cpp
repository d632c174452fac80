#include "services/owner/command_ledger.hpp"

#include <algorithm>
#include <utility>

namespace roci::services::owner {

using temporal::Time;

namespace {

bool is_last(const std::optional<Word>& word) { return word && word->stage != Stage::accepted; }

}  // namespace

Reception CommandLedger::receive(const Request& request, Time now) {
  if (auto refusal = refuse_old(request, now)) return {Reception::Order::nothing, std::move(refusal)};
  switch (request.action) {
    case Action::query:
      return {Reception::Order::nothing, answer(request.key, now)};
    case Action::cancel:
      return cancel(request, now);
    case Action::execute:
      break;
  }
  return execute(request, now);
}

std::optional<Ack> CommandLedger::refuse_old(const Request& request, Time now) {
  std::uint64_t& newest = epochs_[request.sender];
  if (request.epoch >= newest) {
    newest = request.epoch;
    return std::nullopt;
  }
  Word word{Stage::rejected, "old-epoch",
            "epoch " + std::to_string(request.epoch) + " is over; the executive in charge has epoch " +
                std::to_string(newest)};
  return Ack{request.key, std::move(word), now, newest, true};
}

Reception CommandLedger::execute(const Request& request, Time now) {
  const auto [record, is_new] = records_.try_emplace(request.key);
  if (!is_new) {
    if (!record->second.word) return {};  // its word is still to come
    return {Reception::Order::nothing, answer(request.key, now)};
  }
  record->second.robot = request.robot;
  record->second.subsystem = request.subsystem;
  record->second.latest_end = request.latest_end;
  return {Reception::Order::carry_out, std::nullopt};
}

Reception CommandLedger::cancel(const Request& request, Time now) {
  if (Record* record = open_record(request.key)) {
    if (std::exchange(record->cancelling, true)) return {};  // its outcome is still to come
    return {Reception::Order::break_off, std::nullopt};
  }
  Ack word = answer(request.key, now);
  if (word.word.stage != Stage::unknown) {
    word.word = {Stage::cancel_failed, "already-ended", "it has already ended (" + word.word.code + ")"};
  }
  return {Reception::Order::nothing, std::move(word)};
}

CommandLedger::Record* CommandLedger::open_record(const CommandKey& key) {
  const auto found = records_.find(key);
  if (found == records_.end() || is_last(found->second.word)) return nullptr;
  return &found->second;
}

std::optional<Ack> CommandLedger::say(const CommandKey& key, Word word, Time now) {
  Record* record = open_record(key);
  if (!record || word.stage == Stage::cancel_failed || word.stage == Stage::unknown) return std::nullopt;
  if (!record->word) record->accepted = now;
  if (word.stage != Stage::accepted && word.stage != Stage::rejected && !word.results.duration) {
    word.results.duration = now - record->accepted;
  }
  record->word = std::move(word);
  return ack(key, *record->word, now);
}

std::optional<Ack> CommandLedger::refuse_cancel(const CommandKey& key, std::string reason, Time now) {
  Record* record = open_record(key);
  if (!record || !std::exchange(record->cancelling, false)) return std::nullopt;
  return ack(key, {Stage::cancel_failed, "cannot-cancel", std::move(reason)}, now);
}

std::optional<Ack> CommandLedger::repair(const CommandKey& key, std::string reason, Time now) {
  Record* record = open_record(key);
  if (!record || !record->word || (record->latest_end && now >= *record->latest_end)) return std::nullopt;
  record->repaired = true;
  return say(key, {Stage::accepted, "repairing", std::move(reason)}, now);
}

std::optional<Time> CommandLedger::next_overrun() const {
  std::optional<Time> first;
  for (const auto& [key, record] : records_) {
    if (!record.repaired || !record.latest_end || is_last(record.word)) continue;
    if (!first || *record.latest_end < *first) first = record.latest_end;
  }
  return first;
}

std::vector<CommandKey> CommandLedger::take_overruns(Time now) {
  std::vector<CommandKey> out;
  for (auto& [key, record] : records_) {
    const bool limited = record.repaired && record.latest_end && !is_last(record.word);
    if (!limited || *record.latest_end > now) continue;
    record.repaired = false;
    out.push_back(key);
  }
  return out;
}

std::vector<CommandKey> CommandLedger::open(const std::string& robot, const std::string& subsystem) const {
  std::vector<CommandKey> out;
  for (const auto& [key, record] : records_) {
    if (record.robot == robot && record.subsystem == subsystem && !is_last(record.word)) out.push_back(key);
  }
  return out;
}

Ack CommandLedger::answer(const CommandKey& key, Time now) const {
  const auto record = records_.find(key);
  if (record == records_.end()) {
    return ack(key, {Stage::unknown, "unknown-key", "this activity was never commanded here"}, now);
  }
  // What was taken and not yet worded is on its way.
  return ack(key, record->second.word.value_or(Word{}), now);
}

Ack CommandLedger::ack(const CommandKey& key, Word word, Time now) const {
  const auto epoch = epochs_.find(key.commander);
  return {key, std::move(word), now, epoch == epochs_.end() ? 0 : epoch->second};
}

}  // namespace roci::services::owner
