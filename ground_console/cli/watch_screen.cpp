// The screen of `roci watch`: mission, goals, the plan as bars over time, the robot, what happened last.
#include <algorithm>

#include "ground_console/cli/report.hpp"

namespace roci::console {
namespace {

constexpr std::int64_t kNotYet = -1;

// Lines cut and padded to the width of the screen; UTF-8 continuation bytes take no column.
std::string cut(const std::string& text, std::size_t width) {
  std::string out;
  std::size_t columns = 0;
  for (std::size_t i = 0; i < text.size(); ++i) {
    const bool continuation = (static_cast<unsigned char>(text[i]) & 0xC0U) == 0x80U;
    if (!continuation && columns == width) break;
    columns += continuation ? 0 : 1;
    out += text[i];
  }
  return out;
}

struct Span {
  std::int64_t from;
  std::int64_t to;
};

// When an activity is, or is expected to be.
Span span_of(const v1::PlanActivity& activity, const v1::StepStatus* step, std::int64_t now) {
  if (step == nullptr) return {now, now};
  const std::int64_t from = step->started_us() == kNotYet ? step->earliest_start_us() : step->started_us();
  if (step->ended_us() != kNotYet) return {from, step->ended_us()};
  return {from, std::max(from + activity.duration_lower_us(), step->started_us() == kNotYet ? from : now)};
}

class PlanChart {
 public:
  PlanChart(const MissionView& view, std::size_t columns) : view_(view), columns_(columns) {
    first_ = last_ = view.now_us();
    for (const v1::PlanActivity& activity : view.plan()->activities()) {
      const Span span = span_of(activity, view.step(activity.id()), view.now_us());
      first_ = std::min(first_, span.from);
      last_ = std::max(last_, span.to);
    }
    last_ = std::max(last_, first_ + 1);
  }

  // "▒" planned, "█" done or running, "│" now.
  std::string bar(const v1::PlanActivity& activity) const {
    const v1::StepStatus* step = view_.step(activity.id());
    const Span span = span_of(activity, step, view_.now_us());
    const bool begun = step != nullptr && step->started_us() != kNotYet;
    const bool ended = step != nullptr && step->ended_us() != kNotYet;
    std::string out;
    for (std::size_t column = 0; column < columns_; ++column) {
      const bool inside = column >= column_of(span.from) && column <= column_of(span.to);
      if (inside && begun && (ended || column <= column_of(view_.now_us()))) {
        out += "█";
      } else if (inside) {
        out += "▒";
      } else {
        out += column == column_of(view_.now_us()) ? "│" : " ";
      }
    }
    return out;
  }

  std::string axis() const {
    const std::string from = clock_text(first_);
    const std::string to = clock_text(last_);
    const std::size_t gap = columns_ > from.size() + to.size() ? columns_ - from.size() - to.size() : 1;
    return from + std::string(gap, ' ') + to;
  }

 private:
  std::size_t column_of(std::int64_t time) const {
    const double share = static_cast<double>(time - first_) / static_cast<double>(last_ - first_);
    return static_cast<std::size_t>(std::clamp(share, 0.0, 1.0) * static_cast<double>(columns_ - 1));
  }

  const MissionView& view_;
  std::size_t columns_;
  std::int64_t first_ = 0;
  std::int64_t last_ = 1;
};

std::string label_of(const v1::PlanActivity& activity, const v1::StepStatus* step) {
  std::string out = activity.name();
  for (const v1::Property& argument : activity.arguments()) {
    const bool is_name = argument.value().find_first_not_of("0123456789.-") != std::string::npos;
    if (is_name) out += " " + argument.value();
  }
  out = cut(out, 30);
  out.resize(31, ' ');
  std::string state = step == nullptr ? "waiting" : name_of(step->state());
  state.resize(11, ' ');
  return out + state;
}

void add_plan(const MissionView& view, std::size_t width, std::size_t room, std::vector<std::string>& lines) {
  if (!view.plan() || room < 3) return;
  constexpr std::size_t kLabel = 2 + 31 + 11;
  const std::size_t columns = width > kLabel + 20 ? width - kLabel - 1 : 20;
  const PlanChart chart(view, columns);
  const auto& activities = view.plan()->activities();
  lines.push_back("Plan " + std::to_string(view.plan()->version()));
  lines.back().resize(kLabel, ' ');
  lines.back() += chart.axis();
  // When not all fit, the past scrolls out.
  const std::size_t shown = std::min(room - 1, activities.size());
  std::size_t begin = 0;
  while (begin + shown < activities.size()) {
    const v1::StepStatus* step = view.step(activities[begin].id());
    if (step == nullptr || step->ended_us() == kNotYet) break;
    ++begin;
  }
  for (std::size_t i = begin; i < std::min(begin + shown, activities.size()); ++i) {
    lines.push_back("  " + label_of(activities[i], view.step(activities[i].id())) + chart.bar(activities[i]));
  }
}

std::string robot_line(const MissionView& view) {
  std::string out;
  for (const auto& [name, observation] : view.timelines()) {
    if (observation.observed().kind() != v1::VALUE_STATE || name.find('.') == std::string::npos) continue;
    if (!name.starts_with("rover.")) continue;
    out += (out.empty() ? "" : "   ") + name.substr(6) + " " + value_text(observation.observed());
  }
  return out;
}

}  // namespace

std::string watch_screen(const MissionView& view, std::size_t width, std::size_t height) {
  std::vector<std::string> lines;
  const auto& mission = view.mission();
  lines.push_back((mission ? mission->mission() : std::string("waiting for exec_svc")) + "   " +
                  clock_text(view.now_us()) +
                  (mission ? std::string("   ") + name_of(mission->phase()) + "   plan " +
                                 std::to_string(mission->plan_version()) + "   replans " +
                                 std::to_string(mission->replans()) +
                                 (mission->outcome().empty() ? "" : "   result: " + mission->outcome())
                           : ""));
  lines.push_back("");
  lines.push_back("Goals");
  for (const auto& [key, status] : view.goals()) lines.push_back("  " + goal_line(status));
  lines.push_back("");
  constexpr std::size_t kEventLines = 8;
  const std::size_t used = lines.size() + kEventLines + 4;
  add_plan(view, width, height > used ? height - used : 0, lines);
  lines.push_back("");
  lines.push_back("Robot  " + robot_line(view));
  lines.push_back("");
  lines.push_back("Events");
  const auto& events = view.events();
  const std::size_t room = height > lines.size() ? height - lines.size() : 0;
  const std::size_t count = std::min(room, events.size());
  for (std::size_t i = events.size() - count; i < events.size(); ++i)
    lines.push_back("  " + event_line(events[i]));
  std::string out;
  for (std::size_t i = 0; i < std::min(height, lines.size()); ++i) out += cut(lines[i], width) + "\n";
  return out;
}

}  // namespace roci::console
