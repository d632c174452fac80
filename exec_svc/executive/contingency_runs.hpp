// Contingency runs are the contingencies under way: the commands of a template, one after the other, after
// an activity has failed (R69, R70). Other activities run on meanwhile (R141).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <unordered_map>
#include <vector>

#include "exec_svc/executive/run_state.hpp"

namespace roci::exec::executive {

/// Says that a contingency has come to its end.
struct ContingencyEnd {
  Index activity = 0;
  std::string failure;  ///< failure of the activity for which it was begun
  std::string reason;   ///< says why it did not help; empty: all of its commands are done
};

/// Holds by activity the contingency that is under way or was used.
class ContingencyRuns {
 public:
  /// The state must outlive this object.
  explicit ContingencyRuns(RunState& state) : state_(&state), records_(state.plan.activities.size()) {}

  /// Returns the contingency that may still be used for an activity that has been started, or null if there
  /// is none.
  const Contingency* usable(Index activity) const;
  /// Sends its first command. Returns false if there is none to use.
  bool begin(Index activity, temporal::Time now, const std::string& failure);
  /// Lets no contingency be used for the activity any more.
  void exhaust(Index activity);

  /// Returns whether the command that it answers is the one that a contingency waits for.
  bool expects(const CommandAck& ack) const;
  /// Goes on to the next command, or ends.
  std::optional<ContingencyEnd> take(const CommandAck& ack, temporal::Time now);
  /// Returns its end, if its commands are done or its time has passed.
  std::optional<ContingencyEnd> check(Index activity, temporal::Time now);
  std::optional<ContingencyEnd> lose_owner(Index activity, const std::string& owner,
                                           const std::string& reason);
  void cancel(Index activity) { send(activity, CommandAction::cancel); }
  /// Asks, after a restart, what became of its command.
  void query(Index activity, temporal::Time now);
  /// Returns when check() will have something to say.
  temporal::Time timer(Index activity) const;

  /// Takes over from the run before what must not come again, the keys of commands; with `goes_on`, all of
  /// it.
  void inherit(Index activity, const ContingencyRuns& before, Index activity_before, bool goes_on);

 private:
  struct Record {
    std::size_t command = 0;  ///< index of the one that runs; as many as there are: all are done
    std::string command_id;   ///< id of the command that was sent last
    std::uint64_t epoch = 0;  ///< executive's epoch when it was issued
    temporal::Time since{0};  ///< says when the contingency began
    temporal::Time command_since{0};
    bool accepted = false;
    std::string failure;         ///< failure of the activity
    std::uint32_t used = 0;      ///< contingencies begun
    std::uint32_t commands = 0;  ///< part of their keys: it is never reset
    std::uint32_t queries = 0;   ///< how often its owner was asked because no answer came over a link
    bool asked = false;          ///< the newest thing that its owner was sent is a query
  };

  const Contingency& contingency(Index activity) const;
  void send(Index activity, CommandAction action);
  const std::string& owner(Index activity) const;  ///< of the command that runs
  ContingencyEnd ended(Index activity, const std::string& reason) const;

  RunState* state_;
  std::vector<Record> records_;                         ///< are indexed by activity
  std::unordered_map<std::string, Index> activity_of_;  ///< goes by the id of a contingency's command
};

}  // namespace roci::exec::executive
