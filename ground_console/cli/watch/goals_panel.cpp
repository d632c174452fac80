#include "ground_console/cli/report.hpp"
#include "ground_console/cli/watch/panels.hpp"

namespace roci::console::cli::watch {
namespace {

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

// Where the columns of a goal begin. Of a narrow panel kind and class are left out.
struct GoalColumns {
  std::size_t name_width = 17;
  std::size_t kind = 22;
  std::size_t importance = 34;
  std::size_t rest = 48;
  bool narrow = false;
};

GoalColumns columns_for(std::size_t width) {
  if (width >= 70) return {};
  return {12, 0, 0, 17, true};
}

}  // namespace

void draw_goals(const lib::MissionView& view, const Rectangle& area, Canvas& canvas) {
  std::size_t row = area.row;
  canvas.put(row++, area.column, "Goals", Style::title);
  std::size_t number = 0;
  const GoalColumns columns = columns_for(area.width);
  for (const auto& [key, status] : view.goals()) {
    if (row + 1 >= area.row + area.height && number + 1 < view.goals().size()) {
      canvas.put(row, area.column + 2, "… " + std::to_string(view.goals().size() - number) + " more",
                 Style::dim);
      return;
    }
    const GoalLook look = goal_look(status.goal_state());
    const std::string name = status.issuer() == "ground" ? status.id() : status.issuer() + "/" + status.id();
    canvas.put(row, area.column, std::string(1, goal_letter(number++)), Style::title);
    canvas.put(row, area.column + 2, look.sign, look.style);
    canvas.put(row, area.column + 4, name, look.style, columns.name_width);
    if (!columns.narrow) {
      canvas.put(row, area.column + columns.kind, status.goal_kind(), Style::plain, 11);
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
