// The ledger keeps the rules that any owner of commands keeps, as a functional core: requests and the owner's
// own words go in, acknowledgements and orders come out; the time is an argument.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "services/owner/command.hpp"

namespace roci::services::owner {

/// Says what the owner has to do about a request.
struct Reception {
  enum class Order {
    nothing,    ///< the acknowledgement, if there is one, says all
    carry_out,  ///< the command is new: begin or reject it
    break_off,  ///< end it with word(…, cancelled) or refuse with refuse_cancel()
  };
  Order order = Order::nothing;
  std::optional<Ack> ack{};  ///< is to be sent at once
};

/// Takes each key once. What repeats it, and every query, gets the last word again. An older epoch than the
/// newest one of the same sender is refused, and told the newest. A cancel has two phases: the order to break
/// off, and how that went. What ended keeps its last word for good.
class CommandLedger {
 public:
  Reception receive(const Request&, temporal::Time now);

  /// Takes the owner's word on a command that it took and that has no last word yet: accepted, rejected,
  /// completed, failed or cancelled. Returns nothing, without effect, if there is no such command.
  std::optional<Ack> say(const CommandKey&, Word, temporal::Time now);
  /// Takes in that the command runs on although somebody wanted it cancelled. Returns nothing if nobody does.
  std::optional<Ack> refuse_cancel(const CommandKey&, std::string reason, temporal::Time now);

  /// Takes in that the owner tries again by itself (R146): it says so, and a success will look like any
  /// other. Returns nothing if there is no such running command, or its latest end has passed, and the owner
  /// fails it.
  std::optional<Ack> repair(const CommandKey&, std::string reason, temporal::Time now);
  /// Returns when the first repaired command must have ended, or nothing if none is limited.
  std::optional<temporal::Time> next_overrun() const;
  /// Returns the repaired commands that have not ended in time, each once: the owner breaks them off as
  /// failed.
  std::vector<CommandKey> take_overruns(temporal::Time now);

  /// Returns the commands of the robot's subsystem that have no last word.
  std::vector<CommandKey> open(const std::string& robot, const std::string& subsystem) const;
  /// Returns the key's last word, with stage `unknown` for a key never taken.
  Ack answer(const CommandKey&, temporal::Time now) const;

 private:
  struct Record {
    std::string robot;
    std::string subsystem;
    std::optional<temporal::Time> latest_end;
    std::optional<Word> word;  // empty: taken, and nothing said so far
    temporal::Time accepted{};
    bool cancelling = false;
    bool repaired = false;
  };

  std::optional<Ack> refuse_old(const Request&, temporal::Time now);
  Reception execute(const Request&, temporal::Time now);
  Reception cancel(const Request&, temporal::Time now);
  Record* open_record(const CommandKey&);
  Ack ack(const CommandKey&, Word, temporal::Time now) const;

  std::map<std::string, std::uint64_t> epochs_;  // newest by who sent it
  std::map<CommandKey, Record> records_;
};

}  // namespace roci::services::owner
