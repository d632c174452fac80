#include "ground_console/cli/map/run_picture.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <string_view>

#include "ground_console/cli/map/layers.hpp"
#include "ground_console/cli/map/png_file.hpp"
#include "ground_console/cli/outlook/svg.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::map {
namespace {

using outlook::Svg;

constexpr double kWidth = 1200, kEdge = 24, kHead = 64, kGap = 28;
constexpr double kLabel = 210, kBar = 20, kRowStep = 24, kTimes = 30;
constexpr double kMostPixels = 600;  // of the ground's longer side
constexpr const char *kInkColour = "#1d2733", *kQuietColour = "#6b7280", *kTeam = "#5b6470";
constexpr const char *kSoil = "#d9480f", *kRockColour = "#4a3c34", *kHazardColour = "#f08c00";
constexpr std::array kRobotColours{"#144a9c", "#8a1c7c", "#0b7a53", "#a15c00", "#5f3dc4", "#b02a37"};

std::string colour_of(const std::string& robot, const RunPicture& picture) {
  const auto found = std::ranges::find(picture.robots, robot);
  if (found == picture.robots.end()) return kTeam;
  return kRobotColours[static_cast<std::size_t>(found - picture.robots.begin()) % kRobotColours.size()];
}

// Metres of the map in a panel of the picture: north is up.
class Panel {
 public:
  Panel(const terrain::Grid& grid, double x, double y, double width)
      : grid_(grid), x_(x), y_(y), width_(width), scale_(width / grid.width()) {}

  double x() const { return x_; }
  double y() const { return y_; }
  double width() const { return width_; }
  double height() const { return grid_.height() * scale_; }
  double pixels(double metres) const { return metres * scale_; }
  Svg::Point at(terrain::Point p) const {
    return {x_ + (p.x - grid_.origin.x) * scale_, y_ + height() - (p.y - grid_.origin.y) * scale_};
  }
  const terrain::Grid& grid() const { return grid_; }

 private:
  terrain::Grid grid_;
  double x_, y_, width_, scale_;
};

std::vector<Svg::Point> points_of(const Way& way, const Panel& panel) {
  std::vector<Svg::Point> out;
  for (const terrain::Point p : way) out.push_back(panel.at(p));
  return out;
}

std::vector<std::uint8_t> ground_of(const MissionMap& map) {
  const terrain::Grid& grid = map.site.grid();
  const double scale = kMostPixels / std::max(grid.width(), grid.height());
  const double width = std::max(1.0, std::round(grid.width() * scale)),
               height = std::max(1.0, std::round(grid.height() * scale));
  Picture picture(static_cast<int>(width), static_cast<int>(height), kPaper);
  const Scale to_pixels(grid, {0, 0, width, height});
  draw_ground(map.site, to_pixels, picture);
  draw_zones(map, to_pixels, picture);
  return png_bytes(picture);
}

void draw_obstacle(const KnownObstacle& one, const Panel& panel, Svg& svg) {
  const auto [x, y] = panel.at(one.disc.centre);
  const double radius = std::max(3.0, panel.pixels(one.disc.radius));
  const std::string colour = one.kind == "soil" ? kSoil : one.kind == "rock" ? kRockColour : kHazardColour;
  const std::string kind = one.kind.empty() ? "hazard" : one.kind;
  char place[80];
  std::snprintf(place, sizeof place, " at %.2f, %.2f m, radius %.2f m", one.disc.centre.x, one.disc.centre.y,
                one.disc.radius);
  svg.open(kind + " " + one.id + " found by " + one.found_by + place);
  svg.circle(x, y, radius, {.fill = colour, .opacity = 0.3});
  svg.circle(x, y, radius, {.stroke = colour, .width = 1.5, .dashes = one.kind == "soil" ? "4 2" : ""});
  svg.text(x, y + radius + 13, kind + (one.found_by.empty() ? "" : " of " + one.found_by),
           {.size = 11, .colour = colour, .anchor = "middle", .bold = true, .halo = true});
  svg.close();
}

void draw_way(const Way& way, const std::string& colour, bool own, const Panel& panel, Svg& svg) {
  if (way.empty()) return;
  const std::vector<Svg::Point> points = points_of(way, panel);
  if (own) svg.polyline(points, {.stroke = "#ffffff", .width = 5.5, .opacity = 0.8});
  svg.polyline(points, {.stroke = colour, .width = own ? 3.0 : 1.5, .dashes = own ? "" : "3 3"});
  if (own)
    svg.circle(points.front().first, points.front().second, 4.5,
               {.fill = "#ffffff", .stroke = colour, .width = 2});
  svg.circle(points.back().first, points.back().second, own ? 6 : 4,
             {.fill = colour, .stroke = "#ffffff", .width = 1.5});
}

void draw_places(const MissionMap& map, const Panel& panel, Svg& svg) {
  for (const NamedPlace& place : map.places) {
    const auto [x, y] = panel.at(place.at);
    svg.circle(x, y, 2.5, {.fill = kInkColour, .stroke = "#ffffff", .width = 1});
  }
}

struct Label {
  double x, y;  // of the text's anchor, on its base line
  const char* anchor;
  double left, width;

  bool meets(const Label& other) const {
    return left < other.left + other.width && other.left < left + width &&
           std::abs(y - other.y) < 0.9 * kLetters;
  }
  static constexpr double kLetters = 10;
};

// Names of places, above all else: over its place, or where other names stand there, beside or below it.
void draw_names(const MissionMap& map, const Panel& panel, Svg& svg) {
  std::vector<Label> taken;
  for (const NamedPlace& place : map.places) {
    const auto [x, y] = panel.at(place.at);
    const double width = 0.6 * Label::kLetters * static_cast<double>(place.name.size());
    const std::array candidates{
        Label{x, y - 6, "middle", x - width / 2, width}, Label{x + 7, y + 3.5, "start", x + 7, width},
        Label{x - 7, y + 3.5, "end", x - 7 - width, width}, Label{x, y + 15, "middle", x - width / 2, width}};
    const auto free = std::ranges::find_if(candidates, [&](const Label& one) {
      return one.left >= panel.x() && one.left + one.width <= panel.x() + panel.width() &&
             std::ranges::none_of(taken, [&](const Label& other) { return one.meets(other); });
    });
    const Label& label = free == candidates.end() ? candidates.front() : *free;
    taken.push_back(label);
    svg.text(label.x, label.y, place.name,
             {.size = Label::kLetters, .colour = kInkColour, .anchor = label.anchor, .halo = true});
  }
}

void draw_scale(const Panel& panel, Svg& svg) {
  const double metres = round_length(panel.grid().width() / 4), length = panel.pixels(metres);
  const double x = panel.x() + 10, y = panel.y() + panel.height() - 12;
  svg.rectangle(x - 4, y - 16, length + 8, 22, {.fill = "#ffffff", .opacity = 0.7}, 3);
  svg.polyline({{x, y - 4}, {x, y}, {x + length, y}, {x + length, y - 4}},
               {.stroke = kInkColour, .width = 1.5});
  svg.text(x + length / 2, y - 4, lib::value_text(metres) + " m", {.size = 10, .anchor = "middle"});
}

void draw_panel(const RunPicture& picture, const std::string& robot, const std::vector<std::uint8_t>& ground,
                const Panel& panel, Svg& svg) {
  const MissionMap& map = *picture.map;
  const auto known = map.known.find(robot);
  const std::size_t count = known == map.known.end() ? map.hazards.size() : known->second.size();
  const std::string title = robot.empty() ? "The ground" : "What " + robot + " knows";
  svg.text(panel.x(), panel.y() - 8,
           title + ": " + std::to_string(count) + (count == 1 ? " obstacle" : " obstacles") +
               (robot.empty() ? "" : " beyond the loaded map"),
           {.size = 13, .colour = robot.empty() ? kInkColour : colour_of(robot, picture), .bold = true});
  svg.clip(panel.x(), panel.y(), panel.width(), panel.height());
  svg.png(panel.x(), panel.y(), panel.width(), panel.height(), ground);
  if (known != map.known.end()) {
    for (const KnownObstacle& one : known->second) draw_obstacle(one, panel, svg);
  } else {
    for (const Circle& one : map.hazards) draw_obstacle({one, "", "", ""}, panel, svg);
  }
  for (const Way& way : map.planned)
    svg.polyline(points_of(way, panel), {.stroke = "#78288c", .width = 2, .dashes = "7 5"});
  for (const auto& [name, way] : map.driven)
    if (!robot.empty() && name != robot) draw_way(way, colour_of(name, picture), false, panel, svg);
  draw_places(map, panel, svg);
  for (const auto& [name, way] : map.driven)
    if (robot.empty() || name == robot) draw_way(way, colour_of(name, picture), true, panel, svg);
  draw_names(map, panel, svg);
  svg.close();
  svg.rectangle(panel.x(), panel.y(), panel.width(), panel.height(), {.stroke = "#9aa1ab", .width = 1});
  draw_scale(panel, svg);
}

// Returns where the next part begins.
double draw_maps(const RunPicture& picture, double top, Svg& svg) {
  const MissionMap& map = *picture.map;
  std::vector<std::string> whose;
  for (const std::string& robot : picture.robots)
    if (map.known.contains(robot)) whose.push_back(robot);
  if (whose.empty()) whose.emplace_back();
  const std::size_t columns = std::min<std::size_t>(whose.size(), 3);
  const double width =
      (kWidth - 2 * kEdge - kGap * static_cast<double>(columns - 1)) / static_cast<double>(columns);
  const terrain::Grid& grid = map.site.grid();
  const double fitting = std::min(width, 620 * grid.width() / grid.height());
  const std::vector<std::uint8_t> ground = ground_of(map);
  double bottom = top;
  for (std::size_t i = 0; i < whose.size(); ++i) {
    if (i > 0 && i % columns == 0) top = bottom + kGap;
    const Panel panel(grid, kEdge + static_cast<double>(i % columns) * (width + kGap), top + 18, fitting);
    draw_panel(picture, whose[i], ground, panel, svg);
    bottom = std::max(bottom, panel.y() + panel.height());
  }
  return bottom + kGap;
}

// The state without its arguments.
std::string_view state_of(const std::string& value) {
  return std::string_view(value).substr(0, value.find('('));
}

struct Time {
  double left, width;
  std::int64_t end_us;
  double x(std::int64_t at) const {
    return left +
           width * static_cast<double>(std::clamp<std::int64_t>(at, 0, end_us)) / static_cast<double>(end_us);
  }
};

void draw_row(const Row& row, const std::string& colour, const Time& time, double y, Svg& svg) {
  svg.text_within(kEdge, y + 14, kLabel - 8, row.timeline, {.size = 12, .colour = colour});
  for (const Held& held : row.held) {
    const double from = time.x(held.from_us), width = std::max(1.0, time.x(held.to_us) - from);
    svg.open(row.timeline + ": " + held.value + ", " + lib::clock_text(held.from_us) + " to " +
             lib::clock_text(held.to_us) + (held.planned ? ", planned" : ""));
    const bool pale = held.planned || state_of(held.value) == state_of(row.held.front().value);
    if (held.planned) {
      svg.rectangle(from, y, width, kBar,
                    {.fill = "#ffffff", .stroke = colour, .width = 0.8, .dashes = "3 2"}, 2);
    } else {
      svg.rectangle(from, y, width, kBar, {.fill = "#ffffff"}, 2);
      svg.rectangle(from, y, width, kBar, {.fill = colour, .opacity = pale ? 0.2 : 0.9}, 2);
    }
    svg.text_within(from + 3, y + 14, width - 6, held.value,
                    {.size = 10.5, .colour = pale ? kInkColour : "#ffffff"});
    svg.close();
  }
  for (const std::int64_t at : row.repairs_us) {
    const double x = time.x(at);
    svg.open("a repair begins at " + lib::clock_text(at));
    svg.polygon({{x - 5, y - 3}, {x + 5, y - 3}, {x, y + 6}},
                {.fill = kSoil, .stroke = "#ffffff", .width = 0.8});
    svg.close();
  }
}

// A step of the axis, so that there are at most ten of them.
std::int64_t step_of(std::int64_t end_us) {
  constexpr std::int64_t kSecond = 1'000'000;
  for (const std::int64_t step :
       {1, 5, 10, 30, 60, 120, 300, 600, 1800, 3600, 7200, 14400, 43200, 86400, 172800, 432000, 864000})
    if (end_us / (step * kSecond) <= 10) return step * kSecond;
  return end_us / 10;
}

double draw_course(const RunPicture& picture, double top, Svg& svg) {
  const Course& course = picture.course;
  std::int64_t end = course.end_us;
  for (const Row& row : course.rows)
    for (const Held& held : row.held) end = std::max(end, held.to_us);
  if (course.rows.empty() || end <= 0) return top;
  const Time time{kEdge + kLabel, kWidth - 2 * kEdge - kLabel - 24, end};
  const double first = top + 30, bottom = first + kRowStep * static_cast<double>(course.rows.size());
  svg.text(kEdge, top + 8, "Timelines", {.size = 13, .bold = true});
  for (std::int64_t at = 0, step = step_of(end); at <= end; at += step) {
    svg.line({time.x(at), first - 6}, {time.x(at), bottom}, {.stroke = "#e3e6ea", .width = 1});
    svg.text(time.x(at), bottom + 14, lib::clock_text(at),
             {.size = 10, .colour = kQuietColour, .anchor = "middle"});
  }
  double y = first;
  for (const Row& row : course.rows) {
    draw_row(row, colour_of(robot_of(row.timeline, picture.robots), picture), time, y, svg);
    y += kRowStep;
  }
  double free = 0;  // from where on the next name of a plan has room
  for (const auto& [at, version] : course.plans) {
    svg.line({time.x(at), first - 6}, {time.x(at), bottom},
             {.stroke = kInkColour, .width = 1, .dashes = "2 3"});
    if (time.x(at) < free) continue;
    svg.text(time.x(at) + 2, first - 9, "plan " + version, {.size = 10, .colour = kInkColour});
    free = time.x(at) + 50;
  }
  const bool planned = std::ranges::any_of(
      course.rows, [](const Row& row) { return std::ranges::any_of(row.held, &Held::planned); });
  if (planned)
    svg.line({time.x(course.end_us), first - 6}, {time.x(course.end_us), bottom},
             {.stroke = kSoil, .width = 1.5});
  return bottom + kTimes;
}

}  // namespace

std::string to_svg(const RunPicture& picture) {
  Svg svg;
  svg.text(kEdge, 32, picture.title, {.size = 20, .bold = true});
  svg.text(kEdge, 52, picture.subtitle, {.size = 12, .colour = kQuietColour});
  double next = kHead + 8;
  if (picture.map) next = draw_maps(picture, next, svg);
  next = draw_course(picture, next, svg);
  return svg.document(kWidth, next + 8, picture.title);
}

}  // namespace roci::console::cli::map
