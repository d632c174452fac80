// These are the verbs of roci. Each returns an exit code (docs/exit-codes.md, "Ground tool").
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "ground_console/cli/mission_words.hpp"
#include "ground_console/lib/client.hpp"

namespace roci::console::cli {

/// Names the exit codes of roci.
enum ExitCode {
  kDone = 0,
  kRefused = 1,
  kBadUsage = 2,
  kNoMission = 3,
  kNotAchieved = 4,  ///< goal add --wait: dropped, failed or recalled
  /// goal add --wait: the mission ended, or nothing was heard of it, before the goal had its end. watch --launcher: the
  /// view was closed before the mission ended.
  kStillOpen = 5,
};

/// Holds the arguments of `roci goal add`.
struct GoalArguments {
  std::string issuer = "ground";
  std::string id;
  std::string kind;
  std::string robot;                   ///< that is to achieve it; empty: the only one
  std::vector<std::string> arguments;  ///< "x=110"
  std::string importance = "optional";
  std::vector<double> utility;  ///< by rank, the highest first
  std::int32_t priority = 0;
  double opens_s = 0;   ///< 0: any time
  double closes_s = 0;  ///< 0: never
  bool waits = false;   ///< for the goal's end
  bool why = false;     ///< the planner's own words, too
};

/// How long a verb waits for the mission's answer, in wall time.
inline constexpr std::chrono::milliseconds kAnswerLimit{15000};

/// Ends the sentence that somebody did not answer within so many seconds, where the mission itself is heard.
inline constexpr char kOnItsWay[] =
    " s, and the mission is heard: what was sent waits for the link to the robot if that is closed or slow "
    "(docs/links.md), and counts when it arrives\n";

/// Throws std::invalid_argument with the remedy where the arguments make no goal.
v1::Goal goal_of(const GoalArguments& arguments);
int add_goal(lib::Client& client, const GoalArguments& arguments, bool json);
int cancel_goal(lib::Client& client, const std::string& issuer, const std::string& id, bool json);
int list_goals(lib::Client& client, bool why, bool json);
int show_status(lib::Client& client, const MissionWords& words, bool json);
/// The running plan; with `why`, the id or the name of an activity, the values that it stands on.
/// A plan that has ended, as it was executed: the one of this version, or for 0 the one that ended last.
int show_executed(lib::Client& client, std::uint32_t version, bool as_json);
int show_plan(lib::Client& client, const std::string& why, bool json);
/// Planned, executed and projected values; a row for each timeline, or, with `names`, every change of these alone.
int show_timelines(lib::Client& client, const std::vector<std::string>& names, const MissionWords& words,
                   bool json);
/// Prints events as they come; `count`: ends after so many, 0: never, unless the mission ends.
int follow_events(lib::Client& client, std::size_t count, bool json);

}  // namespace roci::console::cli
