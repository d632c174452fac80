#include "ground_console/cli/map/course.hpp"

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <set>
#include <string_view>

namespace roci::console::cli::map {
namespace {

// Takes the next word off the front.
std::string_view next_word(std::string_view& rest) {
  const std::size_t end = std::min(rest.find(' '), rest.size());
  const std::string_view out = rest.substr(0, end);
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return out;
}

std::optional<std::int64_t> integer_of(std::string_view text) {
  std::int64_t value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || value < 0) return std::nullopt;
  return value;
}

bool is_number(std::string_view text) {
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

Row* row_of(const std::string& timeline, Course& course) {
  const auto found = std::ranges::find(course.rows, timeline, &Row::timeline);
  if (found != course.rows.end()) return &*found;
  if (course.rows.size() >= kRows) return nullptr;
  course.rows.push_back({timeline});
  return &course.rows.back();
}

// "TIMELINE VALUE sampled US".
void take_observation(std::int64_t at, std::string_view rest, Course& course) {
  const std::string timeline(next_word(rest));
  const std::string_view value = rest.substr(0, rest.rfind(" sampled "));
  if (value.empty() || is_number(value)) return;
  Row* row = row_of(timeline, course);
  if (row == nullptr || row->held.size() >= kChanges) return;
  if (!row->held.empty()) {
    if (row->held.back().value == value) return;
    row->held.back().to_us = at;
  }
  row->held.push_back({std::string(value), at, at});
}

// "ACTIVITY ATTEMPT stage=0 OWNER repairing REASON"; the activity may have blanks in it.
void take_ack(std::int64_t at, std::string_view rest, Course& course) {
  const std::size_t stage = rest.find(" stage=0 ");
  if (stage == std::string_view::npos) return;
  rest.remove_prefix(stage + 9);
  const std::string owner(next_word(rest));
  if (next_word(rest) != "repairing") return;
  const auto row = std::ranges::find(course.rows, owner, &Row::timeline);
  if (row != course.rows.end() && row->repairs_us.size() < kChanges) row->repairs_us.push_back(at);
}

// "ID VERSION origin US; …".
void take_plan(std::string_view rest, Course& course) {
  next_word(rest);
  const std::string version(next_word(rest));
  if (next_word(rest) != "origin") return;
  const auto origin = integer_of(rest.substr(0, rest.find(';')));
  if (origin && course.plans.size() < kChanges) course.plans.emplace_back(*origin, version);
}

// States of levels above the commands, which nobody observes: activities that nobody was commanded. They hold while
// they run; of several that run on one timeline the one that began last is shown.
class Levels {
 public:
  // "ACTIVITY ATTEMPT action=…".
  void take_command(std::string_view rest) {
    rest = rest.substr(0, rest.find(" action="));
    commanded_.emplace(rest.substr(0, rest.rfind(' ')));
  }

  // "ACTIVITY STATE [EARLIEST,LATEST] CAUSE"; the activity is named PLAN-TIMELINE.VALUE, and may have blanks in it.
  void take_step(std::int64_t at, std::string_view rest, Course& course) {
    rest = rest.substr(0, rest.find(" ["));
    const std::size_t blank = rest.rfind(' '), dash = rest.find('-'), open = rest.find('(');
    if (blank == std::string_view::npos || dash == std::string_view::npos) return;
    const std::string activity(rest.substr(0, blank));
    const std::string name = activity.substr(dash + 1);
    const std::size_t dot =
        name.substr(0, open == std::string_view::npos ? open : open - dash - 1).rfind('.');
    const auto state = integer_of(rest.substr(blank + 1));
    if (!state || dot == std::string::npos || commanded_.contains(activity)) return;
    std::vector<Running>& running = running_[name.substr(0, dot)];
    const auto found = std::ranges::find(running, activity, &Running::activity);
    if (*state == kRunning && found == running.end()) {
      running.push_back({activity, name.substr(dot + 1), at});
    } else if (*state > kRunning && found != running.end()) {
      const bool stays = found->since_us == at && running.size() == 1;  // a state that was come to
      running.erase(found);
      if (stays) return;
    } else {
      return;
    }
    show(name.substr(0, dot), running.empty() ? "" : running.back().value, at, course);
  }

  // Nothing is known of these when nothing of the plan runs on them.
  void end(Course& course) const {
    for (const auto& [timeline, open] : shown_)
      if (Row* row = row_of(timeline, course); row != nullptr && open) row->held.back().to_us = course.end_us;
  }
  bool shows(const std::string& timeline) const { return shown_.contains(timeline); }

 private:
  static constexpr std::int64_t kRunning = 2;  // of temporal::ActivityState
  struct Running {
    std::string activity, value;
    std::int64_t since_us = 0;
  };

  void show(const std::string& timeline, const std::string& value, std::int64_t at, Course& course) {
    Row* row = row_of(timeline, course);
    if (row == nullptr || row->held.size() >= kChanges) return;
    bool& open = shown_[timeline];
    if (open && row->held.back().value == value) return;
    if (open) row->held.back().to_us = at;
    open = !value.empty();
    if (open) row->held.push_back({value, at, at});
  }

  std::set<std::string> commanded_;
  std::map<std::string, std::vector<Running>> running_;  // by timeline, in the order of their beginnings
  std::map<std::string, bool> shown_;                    // by timeline: whether it shows a value now
};

}  // namespace

Course course_of(std::istream& trace) {
  Course out;
  Levels levels;
  for (std::string line; std::getline(trace, line);) {
    std::string_view rest = line;
    const auto at = integer_of(next_word(rest));
    const std::string_view kind = next_word(rest);
    if (!at) continue;
    if (kind == "observation") {
      take_observation(*at, rest, out);
    } else if (kind == "ack") {
      take_ack(*at, rest, out);
    } else if (kind == "plan") {
      take_plan(rest, out);
    } else if (kind == "command") {
      levels.take_command(rest);
    } else if (kind == "step") {
      levels.take_step(*at, rest, out);
    } else {
      continue;
    }
    out.end_us = std::max(out.end_us, *at);
  }
  for (Row& row : out.rows)
    if (!row.held.empty() && !levels.shows(row.timeline)) row.held.back().to_us = out.end_us;
  levels.end(out);
  return out;
}

void add_planned(const std::string& timeline, const Changes& changes, std::int64_t until_us, Course& course) {
  Row* row = changes.empty() ? nullptr : row_of(timeline, course);
  if (row == nullptr) return;
  if (!row->held.empty())
    row->held.push_back({row->held.back().value, row->held.back().to_us, changes.front().first, true});
  for (std::size_t i = 0; i < changes.size() && row->held.size() < kChanges; ++i) {
    const std::int64_t to = i + 1 < changes.size() ? changes[i + 1].first : until_us;
    row->held.push_back({changes[i].second, changes[i].first, std::max(to, changes[i].first), true});
  }
}

std::string robot_of(const std::string& timeline, const std::vector<std::string>& robots) {
  for (const std::string& robot : robots)
    if (timeline == robot || timeline.starts_with(robot + ".")) return robot;
  return "";
}

void join_families(Course& course) {
  std::map<std::string, std::vector<const Row*>> families;
  for (const Row& row : course.rows) {
    const std::size_t dot = row.timeline.find('.', row.timeline.find('.') + 1);
    const bool once = row.held.size() == 1 && !row.held.front().planned && row.repairs_us.empty();
    if (once && dot != std::string::npos) families[row.timeline.substr(0, dot + 1)].push_back(&row);
  }
  std::erase_if(families, [](const auto& family) { return family.second.size() < kFamily; });
  std::vector<Row> out;
  std::set<const Row*> joined;
  for (const Row& row : course.rows) {
    if (joined.contains(&row)) continue;
    const auto family = std::ranges::find_if(
        families, [&](const auto& one) { return std::ranges::find(one.second, &row) != one.second.end(); });
    if (family == families.end()) {
      out.push_back(row);
      continue;
    }
    Row all{family->first + "*"};
    for (const Row* one : family->second) {
      joined.insert(one);
      const Held& held = one->held.front();
      all.held.push_back(
          {one->timeline.substr(family->first.size()) + " " + held.value, held.from_us, held.to_us});
    }
    std::ranges::stable_sort(all.held, {}, &Held::from_us);
    for (std::size_t i = 1; i < all.held.size(); ++i) all.held[i - 1].to_us = all.held[i].from_us;
    out.push_back(std::move(all));
  }
  course.rows = std::move(out);
}

void sort_by_robot(const std::vector<std::string>& robots, Course& course) {
  std::ranges::stable_sort(course.rows, {}, [&](const Row& row) {
    const std::string robot = robot_of(row.timeline, robots);
    if (robot.empty()) return std::ptrdiff_t{0};
    return std::ranges::find(robots, robot) - robots.begin() + 1;
  });
}

}  // namespace roci::console::cli::map
