#include "planner_svc/temporal_pddl/cli/gantt.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <sstream>
#include <vector>

namespace roci::planner::temporal_pddl::cli {

using extraction::Activity, extraction::Plan;

namespace {

constexpr double kChart = 1000;    // pixels for the whole makespan
constexpr double kRow = 22;        // height of a row, the gap below its bar included
constexpr double kTop = 48;        // title and scale
constexpr double kLetter = 7;      // width of a letter
constexpr double kNarrowest = 2;   // so that an instant is seen
constexpr std::size_t kName = 28;  // letters of a lane's name
constexpr std::array kColours = {"#7fb3d5", "#f5b041", "#82c99d", "#d98880", "#bb8fce", "#73c6b6",
                                 "#e5c07b", "#a9b7c6", "#f1948a", "#85a5e8", "#c0ca7a", "#d7a98c"};

struct Lane {
  std::string name;
  std::vector<const Activity*> activities;
  std::vector<std::size_t> row;  // of each activity
  std::size_t rows = 1;
};

struct LegendEntry {
  std::string action;
  const char* colour;
  double x, y;  // of its upper left corner
};

std::string escaped(std::string_view text) {
  std::string result;
  for (const char c : text) {
    if (c == '<') {
      result += "&lt;";
    } else if (c == '&') {
      result += "&amp;";
    } else if (c == '"') {
      result += "&quot;";
    } else {
      result += c;
    }
  }
  return result;
}

std::string cut(const std::string& text, std::size_t letters) {
  return text.size() <= letters ? text : letters < 2 ? "" : text.substr(0, letters - 1) + "…";
}

std::string whole_name(const Activity& activity) {
  std::string result = activity.name;
  for (const std::string& argument : activity.arguments) result += " " + argument;
  return result;
}

// In the order of their first activities.
std::vector<Lane> lanes_of(const Plan& plan) {
  std::vector<Lane> lanes;
  for (const Activity& activity : plan.activities) {
    const std::string& name = activity.arguments.empty() ? activity.name : activity.arguments.front();
    auto lane = std::ranges::find(lanes, name, &Lane::name);
    if (lane == lanes.end()) lane = lanes.insert(lanes.end(), Lane{name, {}, {}});
    lane->activities.push_back(&activity);
  }
  for (Lane& lane : lanes) {
    std::vector<temporal::Duration> free_from;  // by row
    for (const Activity* activity : lane.activities) {
      const auto row = std::ranges::find_if(free_from, [&](auto time) { return time <= activity->start; });
      lane.row.push_back(static_cast<std::size_t>(row - free_from.begin()));
      if (row == free_from.end()) {
        free_from.push_back(activity->end);
      } else {
        *row = activity->end;
      }
    }
    lane.rows = std::max<std::size_t>(1, free_from.size());
  }
  return lanes;
}

// The distance of the marks of the scale: 1, 2 or 5 times a power of ten, some ten of them.
double scale_step(double whole) {
  const double power = std::pow(10, std::floor(std::log10(std::max(whole, 1e-3) / 10)));
  for (const double factor : {1, 2, 5})
    if (whole / (factor * power) <= 12) return factor * power;
  return 10 * power;
}

class Picture {
 public:
  Picture(const Plan& plan, std::string_view title) : title_(title), lanes_(lanes_of(plan)) {
    whole_ = std::max(temporal::to_seconds(plan.makespan), 1e-3);
    std::size_t longest = 4;
    for (const Lane& lane : lanes_) {
      rows_ += lane.rows;
      longest = std::max(longest, std::min(lane.name.size(), kName));
    }
    left_ = static_cast<double>(longest) * kLetter + 16;
    chart_end_ = kTop + static_cast<double>(rows_) * kRow;
    lay_out_legend(plan);
  }

  std::string draw() {
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << left_ + kChart + 24 << "\" height=\""
         << height_ << "\" font-family=\"sans-serif\" font-size=\"11\">\n"
         << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
         << "<text x=\"8\" y=\"16\" font-size=\"13\">" << escaped(title_) << "</text>\n";
    draw_scale();
    double y = kTop;
    bool shaded = false;
    for (const Lane& lane : lanes_) {
      draw(lane, y, shaded);
      y += static_cast<double>(lane.rows) * kRow;
      shaded = !shaded;
    }
    for (const LegendEntry& entry : legend_) draw(entry);
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  double x(double time) const { return left_ + time / whole_ * kChart; }

  // Below the chart, an entry for each action in the order of their first starts.
  void lay_out_legend(const Plan& plan) {
    double at = 8, y = chart_end_ + 8;
    for (const Activity& activity : plan.activities) {
      if (colours_.contains(activity.name)) continue;
      const double width = static_cast<double>(activity.name.size()) * kLetter + 32;
      if (at > 8 && at + width > left_ + kChart) {
        at = 8;
        y += kRow;
      }
      legend_.push_back({activity.name, colour(activity.name), at, y});
      at += width;
    }
    height_ = y + kRow + 4;
  }

  void draw(const LegendEntry& entry) {
    out_ << "<rect x=\"" << entry.x << "\" y=\"" << entry.y + 3
         << "\" width=\"12\" height=\"12\" rx=\"2\" fill=\"" << entry.colour
         << "\" stroke=\"#555\" stroke-width=\"0.5\"/>\n<text x=\"" << entry.x + 18 << "\" y=\""
         << entry.y + 13 << "\">" << escaped(entry.action) << "</text>\n";
  }

  void draw_scale() {
    const double step = scale_step(whole_);
    for (double time = 0; time <= whole_ * (1 + 1e-9); time += step) {
      out_ << "<line x1=\"" << x(time) << "\" y1=\"" << kTop - 6 << "\" x2=\"" << x(time) << "\" y2=\""
           << chart_end_ << "\" stroke=\"#ccc\"/>\n<text x=\"" << x(time) << "\" y=\"" << kTop - 10
           << "\" text-anchor=\"middle\" fill=\"#555\">" << time << (time == 0 ? " s" : "") << "</text>\n";
    }
  }

  void draw(const Lane& lane, double y, bool shaded) {
    if (shaded) {
      out_ << "<rect x=\"0\" y=\"" << y - 2 << "\" width=\"100%\" height=\""
           << static_cast<double>(lane.rows) * kRow << "\" fill=\"#888\" fill-opacity=\"0.08\"/>\n";
    }
    out_ << "<text x=\"8\" y=\"" << y + 13 << "\">" << escaped(cut(lane.name, kName)) << "</text>\n";
    for (std::size_t i = 0; i < lane.activities.size(); ++i)
      draw(*lane.activities[i], y + static_cast<double>(lane.row[i]) * kRow);
  }

  void draw(const Activity& activity, double y) {
    const double from = temporal::to_seconds(activity.start), to = temporal::to_seconds(activity.end);
    const double width = std::max(kNarrowest, x(to) - x(from));
    const std::string name = whole_name(activity);
    out_ << "<rect x=\"" << x(from) << "\" y=\"" << y << "\" width=\"" << width << "\" height=\"" << kRow - 4
         << "\" rx=\"2\" fill=\"" << colour(activity.name)
         << "\" stroke=\"#555\" stroke-width=\"0.5\"><title>" << escaped(name) << ": " << from << " to " << to
         << " s</title></rect>\n";
    const std::string label = cut(name, static_cast<std::size_t>(std::max(0.0, width - 8) / kLetter));
    if (!label.empty())
      out_ << "<text x=\"" << x(from) + 3 << "\" y=\"" << y + 13 << "\" pointer-events=\"none\">"
           << escaped(label) << "</text>\n";
  }

  const char* colour(const std::string& action) {
    return kColours[colours_.try_emplace(action, colours_.size()).first->second % kColours.size()];
  }

  std::string title_;
  std::vector<Lane> lanes_;
  std::map<std::string, std::size_t> colours_;
  std::size_t rows_ = 0;
  double whole_ = 0;      // seconds
  double chart_end_ = 0;  // its lower edge
  std::vector<LegendEntry> legend_;
  double left_ = 0;  // where the chart begins
  double height_ = 0;
  std::ostringstream out_;
};

}  // namespace

std::string to_svg(const Plan& plan, std::string_view title) { return Picture(plan, title).draw(); }

}  // namespace roci::planner::temporal_pddl::cli
