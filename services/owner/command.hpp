// An owner of commands and its commanders exchange these plain values.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/temporal/duration.hpp"
#include "core/temporal/value.hpp"

namespace roci::services::owner {

/// Names the command that breaks off whatever its subsystem runs, whoever commanded that. It is taken from
/// anybody of the run, once per key, and raises no epoch.
inline constexpr char kStopCommand[] = "stop";

/// Names the command that moves nothing: its sender says that it commands in its epoch from now on. It is completed
/// at once.
inline constexpr char kLeadCommand[] = "lead";

/// Begins the activity name of every fall-back. A fall-back brings one component to rest (R43, R44); unlike a stop
/// it may be a motion. It raises no epoch, either.
inline constexpr char kFallbackPrefix[] = "fallback.";

/// Bounds by how much a command raises its commander's epoch. A commander that is further ahead, because the
/// owner was restarted, raises it in steps by kLeadCommand; one forged number thus never puts an epoch out of
/// reach.
inline constexpr std::uint64_t kEpochJump = 1000;

/// Names one command for good. A commander that takes over from another one, or from itself after a restart,
/// asks under the old key.
struct CommandKey {
  std::string activity;
  std::uint32_t attempt = 0;
  std::string commander{};         ///< empty where commanders are not told apart
  std::uint64_t issued_epoch = 0;  ///< commander's epoch when it first sent the command
  auto operator<=>(const CommandKey&) const = default;
};

/// Says what a request asks.
enum class Action { execute, cancel, query };

/// Holds what a commander asks: a command, a cancel or a query.
struct Request {
  CommandKey key;
  Action action = Action::execute;
  std::uint64_t epoch = 0;  ///< the sender's present epoch
  std::string sender{};     ///< commander that sends this; not always the one of the key
  std::string robot{};      ///< empty: the owner's only one
  std::string subsystem{};
  std::string command{};
  std::map<std::string, std::string> arguments{};
  /// Holds when the step has to be over at the latest; until then the owner may repair (R146). If it is empty
  /// there is no limit.
  std::optional<temporal::Time> latest_end{};
  std::uint32_t plan = 0;  ///< version of the commander's plan, which never falls in one epoch; 0: not told
  std::uint32_t incarnation = 0;  ///< sender's incarnation; 0: not told
  /// Numbers what the sender has sent; it rises as long as the sender lives.
  std::uint64_t number = 0;
};

/// `accepted` is no last status; `cancel_failed` and `unknown` answer a cancel or a query and are no status of
/// the activity. The order is the one of CommandStage in idl/command.idl.
enum class Stage { accepted, rejected, completed, failed, cancelled, cancel_failed, unknown };

/// Holds the results of a command that ran and ended.
struct Results {
  std::optional<temporal::Duration> duration{};  ///< empty: the time since it was accepted
  std::optional<double> energy_j{};              ///< drawn by it alone; empty: not measured
  std::map<std::string, temporal::Value> values{};
  bool operator==(const Results&) const = default;
};

/// Is where a command stands, as its owner reports it: a stable code for programs, a reason in plain words.
struct CommandStatus {
  Stage stage = Stage::accepted;
  std::string code{};
  std::string reason{};
  Results results{};
  bool operator==(const CommandStatus&) const = default;
};

/// Is the status as it goes out.
struct Ack {
  CommandKey key;
  CommandStatus status;
  temporal::Time at{};
  std::uint64_t newest_epoch = 0;  ///< newest taken from the asker, else from the key's commander
  bool refused_epoch = false;      ///< the request came from an older one
  bool operator==(const Ack&) const = default;
};

}  // namespace roci::services::owner
