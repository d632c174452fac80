// A course is what timelines of states showed over a run, and what they are still to show. It consists of plain
// values, whatever they came from.
#pragma once

#include <cstdint>
#include <istream>
#include <string>
#include <utility>
#include <vector>

namespace roci::console::cli::map {

/// Holds a value of a timeline for a while, in mission time.
struct Held {
  std::string value;
  std::int64_t from_us = 0;
  std::int64_t to_us = 0;
  bool planned = false;  ///< it is still to come
};

/// Holds what one timeline showed, and when its owner repaired.
struct Row {
  std::string timeline;
  std::vector<Held> held{};                ///< by time
  std::vector<std::int64_t> repairs_us{};  ///< when the owner of that name began to repair
};

/// Holds what all timelines showed over a run.
struct Course {
  std::vector<Row> rows{};  ///< in the order in which they were first seen
  /// When plans begin, with their versions.
  std::vector<std::pair<std::int64_t, std::string>> plans{};
  std::int64_t end_us = 0;  ///< of what was seen
};

/// Bounds what a picture can show of one run; what comes beyond it is left out.
inline constexpr std::size_t kRows = 64, kChanges = 2000;

/// Reads the text of `roci-trace print --decisions` (docs/formats.md): observed states and truths, plans, and repairs,
/// which stand at the timeline that has the owner's name; of a plan of several levels (R130) the states above its
/// commands, from the steps whose activities are named TIMELINE.STATE and that nobody is commanded. Numbers, and lines
/// that say none of this, are passed over.
Course course_of(std::istream& trace);

using Changes = std::vector<std::pair<std::int64_t, std::string>>;  ///< time and value, by time

/// Adds the changes that are still to come, until `until_us`: what was seen last stays until the first of them. A
/// timeline that was not seen gets a row of its own.
void add_planned(const std::string& timeline, const Changes& changes, std::int64_t until_us, Course& course);

/// Puts the rows of the team first, then those of each of these robots, each part in its order.
void sort_by_robot(const std::vector<std::string>& robots, Course& course);

/// Joins rows of one family, "primary.way.w0.w1" and so on, that each say one thing once, to one row "primary.way.*"
/// that shows the newest of them ("w0.w1 open"). Families of fewer than kFamily stay as they are.
void join_families(Course& course);
inline constexpr std::size_t kFamily = 3;

/// The robot of these that a timeline belongs to; empty: the team's.
std::string robot_of(const std::string& timeline, const std::vector<std::string>& robots);

}  // namespace roci::console::cli::map
