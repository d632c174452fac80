// The energy forecast with its worst and best case.
#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>

#include "ground_console/cli/outlook/outlook.hpp"
#include "ground_console/cli/outlook/words.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/table.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::outlook {
namespace {

using nlohmann::json;

constexpr double kChart = 980, kHeight = 460;
constexpr double kLeft = 92, kRight = kChart - 150, kUpper = 92, kLower = kHeight - 56;

double finite(double value) { return std::isfinite(value) ? value : 0.0; }

// Returns when nothing is left in the worst case; nothing: it lasts.
std::optional<std::int64_t> empty_in_the_worst_case(const v1::MissionOutlook& outlook) {
  for (const v1::EnergyPoint& point : outlook.energy())
    if (point.worst_j() <= 0) return point.at_us();
  return std::nullopt;
}

std::string verdict(const v1::MissionOutlook& outlook) {
  if (outlook.energy().empty()) return "Nothing is planned.";
  const v1::EnergyPoint& last = outlook.energy().back();
  std::string out = "At " + lib::clock_text(last.at_us()) +
                    ", after all that is planned: " + joules_text(last.predicted_j()) + " left, " +
                    joules_text(last.worst_j()) + " in the worst case, " + joules_text(last.best_j()) +
                    " in the best.";
  if (const auto empty = empty_in_the_worst_case(outlook))
    out += " In the worst case nothing is left from " + lib::clock_text(*empty) + " on.";
  return out;
}

class Course {
 public:
  explicit Course(const v1::MissionOutlook& outlook) : outlook_(outlook) {
    from_s_ = seconds(outlook.energy().front().at_us());
    to_s_ = std::max(from_s_ + 1, seconds(outlook.energy().back().at_us()));
    for (const v1::EnergyPoint& point : outlook.energy())
      most_ = std::max({most_, finite(point.best_j()), finite(point.predicted_j())});
    most_ = std::max(
        1.0, outlook.capacity_j() < 1.6 * most_ ? std::max(most_, finite(outlook.capacity_j())) : most_);
    most_ = std::min(most_, 1e300);
    const double step = marks(0, most_, 6).at(1);
    most_ = std::ceil(most_ / step - 1e-9) * step;  // up to a mark
  }

  std::string draw() {
    draw_title(svg_, "Energy forecast", "Version " + made_text(outlook_));
    draw_legend();
    draw_axes();
    draw_course();
    draw_ends();
    const std::vector<std::string> lines = lines_of(verdict(outlook_), 125);
    double y = kHeight - 4;
    for (const std::string& line : lines) {
      svg_.text(24, y, line, {.size = 12});
      y += 16;
    }
    return svg_.document(kChart, y + 4, "Energy forecast");
  }

 private:
  double x_of(std::int64_t at_us) const {
    return kLeft + (seconds(at_us) - from_s_) / (to_s_ - from_s_) * (kRight - kLeft);
  }
  double y_of(double joules) const {
    return kLower - std::clamp(finite(joules) / most_, 0.0, 1.0) * (kLower - kUpper);
  }

  void draw_legend() {
    svg_.line({kLeft, kTop + 6}, {kLeft + 22, kTop + 6}, {.stroke = kBlue, .width = 2.5});
    svg_.text(kLeft + 28, kTop + 10, outlook_.budget() + " as predicted", {.size = 11});
    const double next = kLeft + 60 + width_of(outlook_.budget() + " as predicted", 11);
    svg_.rectangle(next, kTop + 1, 22, 10, {.fill = kPaleBlue, .opacity = 0.5});
    svg_.text(next + 28, kTop + 10,
              "between the worst case (tasks take 1.1 times as much) and the best (0.9 times)", {.size = 11});
  }

  void draw_axes() {
    for (const double mark : marks(0, most_, 6)) {
      const double y = y_of(mark);
      svg_.line({kLeft, y}, {kRight, y}, {.stroke = mark == 0 ? kFaint : kRule});
      svg_.text(kLeft - 8, y + 4, joules_text(mark), {.size = 11, .colour = kFaint, .anchor = "end"});
    }
    for (const double mark : time_marks(from_s_, to_s_, 8)) {
      const auto at = static_cast<std::int64_t>(mark * 1e6);
      svg_.line({x_of(at), kLower}, {x_of(at), kLower + 5}, {.stroke = kFaint});
      svg_.text(x_of(at), kLower + 19, lib::clock_text(at),
                {.size = 11, .colour = kFaint, .anchor = "middle"});
    }
    if (outlook_.capacity_j() > most_) return;
    svg_.line({kLeft, y_of(outlook_.capacity_j())}, {kRight, y_of(outlook_.capacity_j())},
              {.stroke = kFaint, .dashes = "5 4"});
    svg_.text(kRight + 8, y_of(outlook_.capacity_j()) + 4, "full", {.size = 11, .colour = kFaint});
  }

  void draw_course() {
    std::vector<Svg::Point> band, line;
    for (const v1::EnergyPoint& point : outlook_.energy()) {
      band.emplace_back(x_of(point.at_us()), y_of(point.best_j()));
      line.emplace_back(x_of(point.at_us()), y_of(point.predicted_j()));
    }
    for (auto point = outlook_.energy().rbegin(); point != outlook_.energy().rend(); ++point)
      band.emplace_back(x_of(point->at_us()), y_of(point->worst_j()));
    svg_.polygon(band, {.fill = kPaleBlue, .opacity = 0.5});
    svg_.polyline(line, {.stroke = kBlue, .width = 2.5});
    for (const v1::EnergyPoint& point : outlook_.energy()) {
      if (point.activity().empty()) continue;
      svg_.open(lib::clock_text(point.at_us()) + "  " + point.activity() + "  " +
                joules_text(point.predicted_j()));
      svg_.circle(x_of(point.at_us()), y_of(point.predicted_j()), outlook_.energy().size() > 60 ? 1.5 : 3,
                  {.fill = kBlue});
      svg_.close();
    }
  }

  // What is left in the end, and where the worst case ends.
  void draw_ends() {
    const v1::EnergyPoint& last = outlook_.energy().back();
    struct Label {
      double y;
      std::string text;
      const char* colour;
    };
    std::vector<Label> labels{{y_of(last.best_j()), joules_text(last.best_j()) + " best", kFaint},
                              {y_of(last.predicted_j()), joules_text(last.predicted_j()), kBlue},
                              {y_of(last.worst_j()), joules_text(last.worst_j()) + " worst", kFaint}};
    for (std::size_t i = 1; i < labels.size(); ++i) labels[i].y = std::max(labels[i].y, labels[i - 1].y + 15);
    const double below = std::max(0.0, labels.back().y - kLower);
    for (const Label& label : labels)
      svg_.text(kRight + 10, label.y + 4 - below, label.text,
                {.size = 11.5, .colour = label.colour, .bold = label.colour == kBlue});
    if (const auto empty = empty_in_the_worst_case(outlook_)) {
      svg_.line({x_of(*empty), kUpper}, {x_of(*empty), kLower},
                {.stroke = kRed, .width = 1.5, .dashes = "3 3"});
      svg_.text(x_of(*empty) - 6, kUpper + 28, "worst case: empty",
                {.size = 11, .colour = kRed, .anchor = "end"});
    }
  }

  const v1::MissionOutlook& outlook_;
  double from_s_ = 0, to_s_ = 1, most_ = 1;
  Svg svg_;
};

}  // namespace

std::string energy_text(const v1::MissionOutlook& outlook) {
  std::string out = printable("Energy forecast " + made_text(outlook)) + "\n" + verdict(outlook) + "\n\n";
  std::vector<std::vector<std::string>> rows{{"TIME", "PREDICTED", "WORST", "BEST", "AFTER"}};
  for (const v1::EnergyPoint& point : outlook.energy())
    rows.push_back({lib::clock_text(point.at_us()), joules_text(point.predicted_j()),
                    joules_text(point.worst_j()), joules_text(point.best_j()),
                    &point == &outlook.energy().front() ? "now" : point.activity()});
  return out + table_text(rows);
}

json energy_json(const v1::MissionOutlook& outlook) {
  json out = made_json(outlook);
  out["budget"] = outlook.budget();
  out["capacity_j"] = outlook.capacity_j();
  out["energy"] = json::array();
  for (const v1::EnergyPoint& point : outlook.energy())
    out["energy"].push_back({{"time_s", seconds(point.at_us())},
                             {"activity", point.activity()},
                             {"predicted_j", point.predicted_j()},
                             {"worst_j", point.worst_j()},
                             {"best_j", point.best_j()}});
  const auto empty = empty_in_the_worst_case(outlook);
  out["empty_in_worst_case_s"] = empty ? json(seconds(*empty)) : json();
  return out;
}

std::string energy_svg(const v1::MissionOutlook& outlook) {
  if (!outlook.energy().empty()) return Course(outlook).draw();
  Svg svg;
  draw_title(svg, "Energy forecast", "Version " + made_text(outlook));
  svg.text(24, kTop + 14, verdict(outlook));
  return svg.document(kChart, kTop + 40, "Energy forecast");
}

}  // namespace roci::console::cli::outlook
