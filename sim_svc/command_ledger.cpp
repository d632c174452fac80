#include "sim_svc/command_ledger.hpp"

namespace roci::sim {

std::optional<Ack> CommandLedger::take(const ActivityKey& key, std::uint64_t epoch, Time now) {
  if (auto refusal = refuse_old(key, epoch, now)) return refusal;
  if (words_.contains(key)) return answer(key, now);
  return std::nullopt;
}

std::optional<Ack> CommandLedger::refuse_old(const ActivityKey& key, std::uint64_t epoch, Time now) {
  if (epoch < epoch_) {
    return Ack{key,
               Stage::rejected,
               "old-epoch",
               "epoch " + std::to_string(epoch) + " is over; the executive in charge has epoch " +
                   std::to_string(epoch_),
               now,
               epoch_,
               true};
  }
  epoch_ = epoch;
  return std::nullopt;
}

Ack CommandLedger::answer(const ActivityKey& key, Time now) const {
  const auto word = words_.find(key);
  if (word == words_.end()) {
    return {key, Stage::unknown, "unknown-key", "this activity was never commanded here", now};
  }
  Ack out = word->second;
  out.at = now;
  return out;
}

void CommandLedger::note(const Ack& ack) { words_[ack.key] = ack; }

}  // namespace roci::sim
