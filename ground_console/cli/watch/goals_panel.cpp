#include <algorithm>

#include "ground_console/cli/report.hpp"
#include "ground_console/cli/table.hpp"
#include "ground_console/cli/watch/panels.hpp"

namespace roci::console::cli::watch {
namespace {

constexpr std::size_t kLongestName = 24;  // columns
constexpr std::size_t kLongestKind = 16;  // columns

struct GoalLook {
  const char* sign;
  Style style;
};

GoalLook goal_look(v1::GoalState state) {
  switch (state) {
    case v1::GOAL_PENDING:
      return {"○", Style::warning};
    case v1::GOAL_PLANNED:
      return {"◔", Style::active};
    case v1::GOAL_ACHIEVED:
      return {"✔", Style::good};
    case v1::GOAL_RECALLED:
      return {"–", Style::dim};
    case v1::GOAL_REJECTED:
    case v1::GOAL_DROPPED:
    case v1::GOAL_FAILED:
      return {"✘", Style::bad};
  }
  return {"?", Style::plain};
}

std::string window_of(const v1::Goal* goal) {
  if (goal == nullptr || (goal->opens_us() == 0 && goal->closes_us() == 0)) return "";
  if (goal->closes_us() == 0) return "from " + lib::clock_text(goal->opens_us());
  if (goal->opens_us() == 0) return "until " + lib::clock_text(goal->closes_us());
  return lib::clock_text(goal->opens_us()) + "–" + lib::clock_text(goal->closes_us());
}

// Who asks for it, unless the ground does, and its name.
std::string full_name(const v1::GoalStatus& status) {
  return status.issuer() == "ground" ? status.id() : status.issuer() + "/" + status.id();
}

// Where the columns of a goal begin. Of a narrow panel kind and class are left out.
struct GoalColumns {
  std::size_t name_width = 17;
  std::size_t kind_width = 11;
  std::size_t kind = 0;
  std::size_t importance = 0;
  std::size_t rest = 0;
  bool narrow = false;
};

// A wide panel has room for longer names, where there are any.
GoalColumns columns_for(const lib::MissionView& view, std::size_t width) {
  GoalColumns out;
  if (width < 70) return {.name_width = 12, .rest = 17, .narrow = true};
  for (const auto& [key, status] : view.goals()) {
    out.name_width = std::clamp(columns_of(full_name(status)), out.name_width, kLongestName);
    out.kind_width = std::clamp(columns_of(status.goal_kind()), out.kind_width, kLongestKind);
  }
  out.kind = 4 + out.name_width + 1;
  out.importance = out.kind + out.kind_width + 1;
  out.rest = out.importance + 14;
  return out;
}

}  // namespace

void draw_goals(const lib::MissionView& view, const Rectangle& area, Canvas& canvas) {
  std::size_t row = area.row;
  canvas.put(row++, area.column, "Goals", Style::title);
  std::size_t number = 0;
  const GoalColumns columns = columns_for(view, area.width);
  for (const auto& [key, status] : view.goals()) {
    if (row + 1 >= area.row + area.height && number + 1 < view.goals().size()) {
      canvas.put(row, area.column + 2, "… " + std::to_string(view.goals().size() - number) + " more",
                 Style::dim);
      return;
    }
    const GoalLook look = goal_look(status.goal_state());
    canvas.put(row, area.column, std::string(1, goal_letter(number++)), Style::title);
    canvas.put(row, area.column + 2, look.sign, look.style);
    canvas.put(row, area.column + 4, full_name(status), look.style, columns.name_width);
    if (!columns.narrow) {
      canvas.put(row, area.column + columns.kind, status.goal_kind(), Style::plain, columns.kind_width);
      canvas.put(row, area.column + columns.importance, lib::name_of(status.importance()));
    }
    std::string rest = lib::name_of(status.goal_state());
    if (view.leader() != nullptr) rest += std::string(" (") + lib::name_of(status.ack_stage()) + ")";
    if (const std::string window = window_of(view.goal(key)); !window.empty()) rest += ", " + window;
    if (!status.reason().empty()) rest += ", " + reason_of(status);
    canvas.put(row++, area.column + columns.rest, rest, look.style,
               area.width > columns.rest ? area.width - columns.rest : 0);
  }
}

void draw_events(const lib::MissionView& view, const Rectangle& area, Canvas& canvas) {
  canvas.put(area.row, area.column, "Events", Style::title);
  const auto& events = view.events();
  const std::size_t room = area.height > 1 ? area.height - 1 : 0;
  const std::size_t count = std::min(room, events.size());
  for (std::size_t i = 0; i < count; ++i) {
    const v1::Event& event = events[events.size() - count + i];
    const Style style = event.severity_level() == v1::SEVERITY_ERROR     ? Style::bad
                        : event.severity_level() == v1::SEVERITY_WARNING ? Style::warning
                                                                         : Style::plain;
    const std::size_t row = area.row + 1 + i;
    canvas.put(row, area.column + 2, lib::clock_text(event.header().stamp_us()), Style::dim);
    canvas.put(row, area.column + 12, event.header().sender(), Style::dim);
    canvas.put(row, area.column + 26, event.text(), style);
  }
}

}  // namespace roci::console::cli::watch
