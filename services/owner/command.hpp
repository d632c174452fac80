// What an owner of commands and its commanders say to each other, as plain values.
#pragma once

#include <compare>
#include <cstdint>
#include <map>
#include <optional>
#include <string>

#include "core/temporal/duration.hpp"
#include "core/temporal/value.hpp"

namespace roci::services::owner {

/// The command that breaks off whatever its subsystem runs, whoever commanded that.
inline constexpr char kStopCommand[] = "stop";

/// Names one command for good. A commander that takes over from another one, or from itself after a restart,
/// asks under the old key.
struct CommandKey {
  std::string activity;
  std::uint32_t attempt = 0;
  std::string commander{};         ///< empty where commanders are not told apart
  std::uint64_t issued_epoch = 0;  ///< of the commander, when it first sent the command
  auto operator<=>(const CommandKey&) const = default;
};

enum class Action { execute, cancel, query };

struct Request {
  CommandKey key;
  Action action = Action::execute;
  std::uint64_t epoch = 0;  ///< of the commander now
  std::string robot{};      ///< empty: the owner's only one
  std::string subsystem{};
  std::string command{};
  std::map<std::string, std::string> arguments{};
  /// When the step has to be over at the latest; until then the owner may repair (R146). Empty: no limit.
  std::optional<temporal::Time> latest_end{};
};

/// `accepted` is no last word; `cancel_failed` and `unknown` answer a cancel or a query and are no word on
/// the activity. The order is the one of CommandStage in idl/command.idl.
enum class Stage { accepted, rejected, completed, failed, cancelled, cancel_failed, unknown };

/// What a command came to that ran and ended.
struct Results {
  std::optional<temporal::Duration> duration{};  ///< empty: the time since it was accepted
  double energy_j = 0;
  std::map<std::string, temporal::Value> values{};
  bool operator==(const Results&) const = default;
};

/// A word of the owner on a command: a stable code for programs, a reason in plain words.
struct Word {
  Stage stage = Stage::accepted;
  std::string code{};
  std::string reason{};
  Results results{};
  bool operator==(const Word&) const = default;
};

/// The word as it goes out.
struct Ack {
  CommandKey key;
  Word word;
  temporal::Time at{};
  std::uint64_t refused_epoch = 0;  ///< of the request, if it was refused for it
  std::uint64_t newest_epoch = 0;   ///< of that commander, as far as the owner knows; with a refused one
  bool operator==(const Ack&) const = default;
};

}  // namespace roci::services::owner
