#pragma once
#include <cstdint>
#include <map>
#include <optional>
#include <variant>

#include "sim_svc/values.hpp"

namespace roci::sim {

/// What an owner remembers of commands: each (activity, attempt) is taken once, an older epoch of the
/// executive is refused, and the last word on every key stays known.
class CommandLedger {
 public:
  /// Empty: the key is new and the caller now carries it out. Otherwise the answer to a repeated key (its
  /// last word again) or to an older epoch (rejected).
  std::optional<Ack> take(const ActivityKey&, std::uint64_t epoch, Time now);
  /// Refuses an older epoch; for requests that carry nothing out.
  std::optional<Ack> refuse_old(const ActivityKey&, std::uint64_t epoch, Time now);
  /// The key's last word; stage `unknown` for a key never taken.
  Ack answer(const ActivityKey&, Time now) const;
  /// Keeps the word. How a cancel fared is no word on the activity, unless it ended it.
  void note(const Ack&);

 private:
  std::uint64_t epoch_ = 0;
  std::map<ActivityKey, Ack> words_;
};

}  // namespace roci::sim
