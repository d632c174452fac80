// An owner of commands and its commanders say this to each other, as plain values.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/temporal/duration.hpp"
#include "core/temporal/value.hpp"

namespace roci::services::owner {

/// This command breaks off whatever its subsystem runs, whoever commanded that. It is taken from anybody of the
/// run, once per key, and raises no epoch.
inline constexpr char kStopCommand[] = "stop";

/// This command moves nothing: who sends it says that it commands in its epoch from now on. It is completed at once.
inline constexpr char kLeadCommand[] = "lead";

/// Activities of fall-backs begin so. A fall-back brings one component to rest (R43, R44); unlike a stop it may be
/// a motion. It raises no epoch, either.
inline constexpr char kFallbackPrefix[] = "fallback.";

/// A command that is taken raises its commander's epoch by so much at most. Whoever is further ahead, because
/// the owner was started anew, climbs by kLeadCommand; so one forged number is never out of reach.
inline constexpr std::uint64_t kEpochJump = 1000;

/// Names one command for good. A commander that takes over from another one, or from itself after a restart,
/// asks under the old key.
struct CommandKey {
  std::string activity;
  std::uint32_t attempt = 0;
  std::string commander{};         ///< empty where commanders are not told apart
  std::uint64_t issued_epoch = 0;  ///< is the commander's when it first sent the command
  auto operator<=>(const CommandKey&) const = default;
};

enum class Action { execute, cancel, query };

/// Is what a commander asks: a command, a cancel or a query.
struct Request {
  CommandKey key;
  Action action = Action::execute;
  std::uint64_t epoch = 0;  ///< is the sender's now
  std::string sender{};     ///< the commander that says this; not always the one of the key
  std::string robot{};      ///< empty: the owner's only one
  std::string subsystem{};
  std::string command{};
  std::map<std::string, std::string> arguments{};
  /// Holds when the step has to be over at the latest; until then the owner may repair (R146). If it is empty
  /// there is no limit.
  std::optional<temporal::Time> latest_end{};
  std::uint32_t plan = 0;  ///< version of the commander's plan, which never falls in one epoch; 0: not told
  std::uint32_t incarnation = 0;  ///< of the sender; 0: not told
  /// Counts what the sender has sent; it rises while that lives.
  std::uint64_t number = 0;
};

/// `accepted` is no last status; `cancel_failed` and `unknown` answer a cancel or a query and are no status of
/// the activity. The order is the one of CommandStage in idl/command.idl.
enum class Stage { accepted, rejected, completed, failed, cancelled, cancel_failed, unknown };

/// Holds what a command came to that ran and ended.
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
  std::uint64_t newest_epoch = 0;  ///< that the owner has taken of who asked; else of the key's commander
  bool refused_epoch = false;      ///< the request came from an older one
  bool operator==(const Ack&) const = default;
};

}  // namespace roci::services::owner
