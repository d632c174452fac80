// The retention of ended commands: an owner that runs for years keeps the last statuses of the newest ones and can tell
// an older key from one that it never heard.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "services/owner/command.hpp"

namespace roci::services::owner {

/// Orders the commands of one commander by its epoch when it first sent them, and by their plan. Neither ever
/// falls for what a commander sends for the first time, so what is at or before a mark that was passed is old.
struct IssueMark {
  std::uint64_t epoch = 0;
  std::uint32_t plan = 0;
  auto operator<=>(const IssueMark&) const = default;
};

/// Says which ended keys may be forgotten. Guarantees: a key that was forgotten is recognised for good by its mark, so
/// it is never carried out again; the newest kKept ended keys are not forgotten, nor any of a commander's newest plan.
/// What does not count (a stop, a fall-back, what is sent in another's name) or tells no plan cannot be told from a new
/// one once it is forgotten, so more of it is kept: kWithoutPlan to twice as many, then the oldest go. It moves no
/// mark, or one forged epoch would make all that its commander sends look old.
class Retention {
 public:
  /// So many ended commands keep their last status. Whoever asks for one asks for what it commanded last: after a lost
  /// answer or a restart, a handful.
  static constexpr std::size_t kKept = 200;
  /// A stop each ten seconds for a day. One that comes again after so many others stops what is stopped.
  static constexpr std::size_t kWithoutPlan = 10'000;

  /// Takes in that a key was taken that counts: its sender and epoch were checked.
  void taken(const CommandKey&, std::uint32_t plan);
  /// Takes in that the key has its last status, and whether it counts.
  void ended(const CommandKey&, std::uint32_t plan, bool counts);
  /// Takes in that the commander is forgotten: its marks are, too.
  void forget(const std::string& commander);

  /// Returns the keys to be forgotten now, and marks them; each once. There are none until kKept more have ended.
  std::vector<CommandKey> take_due();

  /// Returns whether a key that the owner does not know is one that it has forgotten.
  bool forgotten(const CommandKey&, std::uint32_t plan) const;

  /// Returns the newest mark that was forgotten, by commander; these are what must outlive the process.
  const std::map<std::string, IssueMark>& forgotten_marks() const { return forgotten_; }
  void restore(const std::string& commander, IssueMark forgotten);

  struct Ended {
    CommandKey key;
    IssueMark mark;
    bool counts = false;
  };
  /// Returns the ended keys that are not forgotten, the oldest first.
  const std::vector<Ended>& ended() const { return ended_; }

 private:
  IssueMark newest(const std::string& commander) const;

  std::map<std::string, IssueMark> newest_, forgotten_;  // by commander
  std::vector<Ended> ended_;                             // the oldest first
  std::size_t look_again_at_ = 2 * kKept;                // bounds how often they are searched
};

}  // namespace roci::services::owner
