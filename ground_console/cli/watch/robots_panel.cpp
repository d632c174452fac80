#include <algorithm>

#include "ground_console/cli/orders.hpp"
#include "ground_console/cli/table.hpp"
#include "ground_console/cli/watch/panels.hpp"

namespace roci::console::cli::watch {
namespace {

constexpr std::size_t kLeastColumn = 36;  // columns of one robot
constexpr std::size_t kGap = 3;
constexpr std::size_t kMostStates = 4;  // rows
constexpr std::size_t kMostMap = 2;     // rows of words on a map
constexpr std::size_t kPicture = 10;    // rows of its picture
constexpr std::size_t kMostOpen = 4;    // rows, of decisions and repairs each

// Parts one after the other, as many in a row as fit. A row begins further in than the first one.
std::vector<std::string> in_rows(const std::vector<std::string>& parts, std::size_t width,
                                 const char* between) {
  std::vector<std::string> out;
  for (const std::string& part : parts) {
    const bool joins =
        !out.empty() && columns_of(out.back()) + columns_of(between) + columns_of(part) <= width;
    if (joins) {
      out.back() += between + part;
    } else {
      out.push_back(part);
    }
  }
  return out;
}

// Broken at blanks.
std::vector<std::string> wrapped(const std::string& text, std::size_t width) {
  std::vector<std::string> words;
  for (std::size_t from = 0; from <= text.size();) {
    const std::size_t to = std::min(text.find(' ', from), text.size());
    words.push_back(text.substr(from, to - from));
    from = to + 1;
  }
  return in_rows(words, width, " ");
}

struct Line {
  std::string text;
  Style style = Style::plain;
};

std::vector<Line> lines_of(const lib::MissionView& view, const Robot& robot, const MissionWords& words,
                           std::size_t width) {
  std::vector<Line> out{
      {(robot.place ? "▲ " : "") + robot.name + (robot.doing.empty() ? "" : "   " + robot.doing),
       Style::title}};
  if (const std::string where = where_text(robot, words); !where.empty()) out.push_back({where});
  std::vector<std::string> states;
  for (const auto& [name, value] : states_by_family(view, robot)) states.push_back(name + " " + value);
  std::vector<std::string> rows = in_rows(states, width, "   ");
  if (rows.size() > kMostStates) {
    rows.resize(kMostStates);
    rows.back() = "… and more: roci status";
  }
  for (std::string& row : rows) out.push_back({std::move(row)});
  for (const v1::KnownMap* map : robot.maps) {
    std::vector<std::string> told = wrapped("map " + map_text(*map), width);
    told.resize(std::min(told.size(), kMostMap));
    for (std::string& row : told) out.push_back({std::move(row), Style::active});
  }
  return out;
}

}  // namespace

std::size_t draw_robots(const lib::MissionView& view, const std::vector<Robot>& all,
                        const MissionWords& words, const Rectangle& area, Canvas& canvas) {
  const std::size_t fitting = std::max<std::size_t>(1, (area.width + kGap) / (kLeastColumn + kGap));
  const std::vector<Robot> robots(all.begin(),
                                  all.begin() + static_cast<std::ptrdiff_t>(std::min(all.size(), fitting)));
  if (robots.empty() || area.height < 2) return 0;
  const std::size_t step = (area.width + kGap) / robots.size(), width = step - std::min(step, kGap);
  std::vector<Rectangle> areas;
  std::size_t used = 0;
  for (std::size_t i = 0; i < robots.size(); ++i) {
    std::size_t row = 0;
    for (const Line& line : lines_of(view, robots[i], words, width)) {
      if (row >= area.height) break;
      canvas.put(area.row + row++, area.column + i * step, line.text, line.style, width);
    }
    used = std::max(used, row);
    areas.push_back({0, area.column + i * step, width, 0});
  }
  std::vector<std::string> team;
  for (const auto& [name, value] : states_of_the_team(view, all)) team.push_back(name + " " + value);
  if (all.size() > robots.size())
    team.push_back("… and " + std::to_string(all.size() - robots.size()) + " more robots");
  const bool placed = std::ranges::any_of(robots, [](const Robot& robot) { return robot.place.has_value(); });
  const std::size_t after = used + (team.empty() ? 0 : 1);
  const std::size_t room = area.height > after ? area.height - after : 0;
  if (const std::size_t picture = std::min(kPicture, room); placed && picture >= kLeastMapRows) {
    for (Rectangle& one : areas) {
      one.row = area.row + used;
      one.height = picture;
    }
    draw_maps(view, robots, areas, canvas);
    used += picture;
  }
  if (!team.empty() && used < area.height) {
    const std::size_t column = canvas.put(area.row + used, area.column, "Team", Style::title) + 2;
    canvas.put(area.row + used++, column, joined(team, "   "), Style::plain,
               area.width > column ? area.width - column : 0);
  }
  return used;
}

std::size_t draw_open(const lib::MissionView& view, const Rectangle& area, Canvas& canvas) {
  std::size_t row = 0;
  const auto draw = [&](const std::string& what, const std::vector<Line>& lines) {
    for (std::size_t i = 0; i < std::min(lines.size(), kMostOpen) && row < area.height; ++i) {
      canvas.put(area.row + row, area.column, i == 0 ? what : "", Style::title);
      canvas.put(area.row + row++, area.column + 10, lines[i].text, lines[i].style,
                 area.width > 10 ? area.width - 10 : 0);
    }
  };
  std::vector<Line> decisions, repairs;
  for (const v1::Decision* decision : open_decisions(view))
    decisions.push_back({decision_line(*decision), Style::warning});
  for (const lib::Repair* repair : repairs_of(view)) {
    const bool runs = repair->state == lib::Repair::State::under_way;
    const bool mended = repair->state == lib::Repair::State::mended;
    repairs.push_back({repair_line(view, *repair), runs ? Style::warning : mended ? Style::dim : Style::bad});
  }
  draw("Decide", decisions);
  draw("Repairs", repairs);
  return row;
}

}  // namespace roci::console::cli::watch
