// The ledger keeps the rules that any owner of commands keeps, as a functional core: requests and the owner's
// own words go in, acknowledgements and orders come out; the time is an argument.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "services/owner/command.hpp"
#include "services/owner/retention.hpp"

namespace roci::services::owner {

/// Informs operators of a commander that is not who it should be: a stable code and plain words.
struct Notice {
  std::string code;
  std::string text;
};

/// Says what the owner has to do about a request.
struct Reception {
  enum class Order {
    nothing,    ///< beyond sending the acknowledgement, if there is one
    carry_out,  ///< the command is new: begin or reject it
    break_off,  ///< end it with word(…, cancelled) or refuse with refuse_cancel()
  };
  Order order = Order::nothing;
  std::optional<Ack> ack{};        ///< to be sent at once
  std::optional<Notice> notice{};  ///< to be reported
};

/// Is what must outlive the owner's process: a key with its last status (none: it was taken), and the newest
/// epoch of whoever sent it.
struct LedgerEntry {
  /// Tells the kinds of entries apart. Kinds other than `command` name no activity: `epoch` keeps a sender's newest
  /// epoch alone; `forgotten` says that every key of the commander up to this epoch and plan without an entry of its
  /// own is an old one.
  enum class Kind { command, epoch, forgotten };
  CommandKey key;
  std::string sender;
  std::uint64_t epoch = 0;
  std::optional<CommandStatus> status{};
  std::uint32_t plan = 0;
  Kind kind = Kind::command;
  bool operator==(const LedgerEntry&) const = default;
};

/// Takes each key once. What repeats it, and every query, gets the last status again. A cancel has two phases:
/// the order to break off, and how that went. What ended keeps its last status until it is one of the oldest of many
/// (retention.hpp); then its key is still never taken again, and its answer is `failed`, `forgotten`.
///
/// Epochs are counted by sender. A command or a cancel that is taken raises its sender's epoch, by kEpochJump at
/// most; nothing else does. An epoch that is over, that another process of the same name has used, or that is
/// further ahead is refused and told the newest. A stop is taken from anybody; a fall-back from who holds the
/// subsystem's lease, or from anybody while nobody does.
///
/// The commander whose command a subsystem took last holds its lease (Gray and Cheriton, 1989) until release(). A
/// command that is rejected gives the lease back to who held it before.
class CommandLedger {
 public:
  /// Bounds the commanders that have an epoch here. A new one takes the place of the one that has commanded longest ago
  /// and has neither an open command nor a lease, which is forgotten; if there is none it is refused.
  static constexpr std::size_t kCommanders = 64;

  Reception receive(const Request&, temporal::Time now);

  /// Returns the newest epoch of this commander that was taken; 0: none.
  std::uint64_t newest_epoch(const std::string& commander) const;
  /// Returns the answer to a process that may not command because another one of the same name holds the lease,
  /// in `holder_epoch` (commander_leases.hpp). It takes nothing, so the key stays free.
  Ack refuse_unleased(const Request&, std::uint64_t holder_epoch, temporal::Time now) const;

  /// Takes in that this commander is gone and holds no lease any more.
  void release(const std::string& commander);
  /// Returns who holds the lease of a robot's subsystem, or "" if nobody does.
  std::string lease_holder(const std::string& robot, const std::string& subsystem) const;

  /// Takes the owner's status of a command that it took and that has no last status yet: accepted, rejected,
  /// completed, failed or cancelled. Returns nothing, without effect, if there is no such command.
  std::optional<Ack> say(const CommandKey&, CommandStatus, temporal::Time now);
  /// Takes in that the command runs on although somebody wanted it cancelled. Returns nothing if nobody does.
  std::optional<Ack> refuse_cancel(const CommandKey&, std::string reason, temporal::Time now);

  /// Takes in that the owner tries again by itself (R146). Returns the word to send; a success will look like
  /// any other. Returns nothing if there is no such running command or its latest end has passed; the owner
  /// then fails it.
  std::optional<Ack> repair(const CommandKey&, std::string reason, temporal::Time now);
  /// Returns when the first repaired command will be overdue, a microsecond after its latest end, or nothing if none is
  /// limited.
  std::optional<temporal::Time> next_overrun() const;
  /// Returns the repaired commands that are overdue, each once: the owner breaks them off as failed.
  std::vector<CommandKey> take_overruns(temporal::Time now);

  /// Returns the commands of the robot's subsystem that have no last status.
  std::vector<CommandKey> open(const std::string& robot, const std::string& subsystem) const;
  /// Returns the key's last status, with stage `unknown` for a key never taken.
  Ack answer(const CommandKey&, temporal::Time now) const;

  /// Returns the entries since the last call, in order; the owner must keep them before it acts, or they are lost
  /// with the process.
  std::vector<LedgerEntry> take_entries() { return std::exchange(entries_, {}); }
  /// Returns all that an owner must keep, so that its file may begin anew with it: two entries for each command that is
  /// not forgotten, and a few more.
  std::vector<LedgerEntry> kept() const;
  /// Takes in, before the first request, what an earlier process kept.
  void restore(const LedgerEntry&);
  /// Takes in, after the last restore(), that this owner goes on with a command that the earlier process accepted at
  /// that time. Returns false if the earlier process never took it, or ended it, or had another command open, too,
  /// which may have been a stop.
  bool resume(const Request&, temporal::Time accepted);
  /// Ends the restoration: what else the earlier process had not ended has failed with it.
  void end_restored();

 private:
  struct Lease {
    std::string holder;
    CommandKey by;  // the command that took it
  };
  struct Record {
    std::string robot;
    std::string subsystem;
    std::optional<temporal::Time> latest_end;
    std::optional<CommandStatus> status;  // empty: taken, and nothing said so far
    temporal::Time accepted{};
    bool cancelling = false;
    bool repaired = false;
    std::uint32_t plan = 0;
    bool counts = false;                // for retention_
    std::optional<Lease> lease_before;  // until its first status
  };
  // Holds the newest epoch of one sender, and which of its processes has used it.
  struct Commander {
    std::uint64_t epoch = 0;
    std::uint32_t incarnation = 0;
    std::uint64_t number = 0;
    std::uint64_t used = 0;  // orders commanders by what they sent last
  };
  enum class EpochStatus { current, stale, doubled, ahead, unknown };

  EpochStatus epoch_status_of(const Request&) const;
  std::optional<Reception> refuse(const Request&, EpochStatus, temporal::Time now) const;
  Reception refuse_fallback(const Request&, const std::string& holder, temporal::Time now) const;
  void raise(const Request&);
  std::string replaceable() const;
  void take_lease(const Request&);
  void give_lease_back(const CommandKey&, const Record&);
  Reception execute(const Request&, temporal::Time now);
  Reception execute_for_safety(const Request&, temporal::Time now);
  Reception cancel(const Request&, temporal::Time now);
  Record* open_record(const CommandKey&);
  std::optional<Ack> answer_if_forgotten(const Request&, temporal::Time now) const;
  void end(const CommandKey&, const Record&);
  Ack ack(const CommandKey&, CommandStatus, temporal::Time now) const;

  std::map<std::string, Commander> commanders_;                  // by who sends
  std::map<std::pair<std::string, std::string>, Lease> leases_;  // by robot and subsystem
  std::uint64_t uses_ = 0;
  std::map<CommandKey, Record> records_;
  Retention retention_;
  std::vector<LedgerEntry> entries_;
};

}  // namespace roci::services::owner
