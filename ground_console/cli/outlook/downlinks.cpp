// The downlink schedule (R110, R111, R126, R127).
#include <algorithm>
#include <nlohmann/json.hpp>

#include "ground_console/cli/outlook/outlook.hpp"
#include "ground_console/cli/outlook/words.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/table.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::outlook {
namespace {

using nlohmann::json;

constexpr double kPage = 980;
constexpr double kNames = 212;  // left of the bars
constexpr double kBars = 500;   // the longest window
constexpr double kDownlink = 38;

std::string whether_planned(const v1::ScheduledProduct& data) { return data.exists() ? "" : "planned"; }

json to_json(const v1::ScheduledProduct& data) {
  return {
      {"id", data.id()}, {"exists", data.exists()}, {"bytes", data.bytes()}, {"tier", name_of(data.tier())}};
}

json to_json(const std::vector<v1::UnsentProduct>& list) {
  json out = json::array();
  for (const v1::UnsentProduct& one : list) {
    out.push_back(to_json(one.data()));
    out.back()["why"] = one.why();
  }
  return out;
}

void add_unsent(std::string& out, const char* title, const std::vector<v1::UnsentProduct>& list) {
  if (list.empty()) return;
  std::vector<std::vector<std::string>> rows{{title, "", "TIER", "BYTES", "WHY"}};
  for (const v1::UnsentProduct& one : list)
    rows.push_back({one.data().id(), whether_planned(one.data()), name_of(one.data().tier()),
                    std::to_string(one.data().bytes()), one.why()});
  out += "\n" + table_text(rows);
}

double window_s(const v1::ScheduledDownlink& one) { return seconds(one.end_us()) - seconds(one.start_us()); }

// Returns where the picture goes on below.
double draw_downlink(Svg& svg, const v1::ScheduledDownlink& one, double longest_s, double y) {
  svg.text_within(24, y + 11, kNames - 34, one.activity(), {.size = 12, .bold = true});
  svg.text(24, y + 25, lib::clock_text(one.start_us()) + " – " + lib::clock_text(one.end_us()),
           {.size = 10.5, .colour = kFaint});
  const double scale = kBars / longest_s;
  svg.rectangle(kNames, y, std::max(2.0, window_s(one) * scale), 26, {.fill = kPale, .stroke = kRule}, 2);
  double x = kNames;
  const double per_byte =
      one.bytes() == 0 ? 0 : seconds(one.takes_us()) * scale / static_cast<double>(one.bytes());
  const double end = kNames + std::max(2.0, window_s(one) * scale);
  for (const v1::ScheduledProduct& data : one.products()) {
    const double width = std::min(static_cast<double>(data.bytes()) * per_byte, std::max(0.0, end - x));
    svg.open(data.id() + ", " + bytes_text(data.bytes()) + ", " + name_of(data.tier()) +
             (data.exists() ? "" : ", planned"));
    svg.rectangle(x, y, width, 26,
                  {.fill = colour_of(data.tier()), .stroke = "white", .opacity = data.exists() ? 1.0 : 0.6});
    svg.text_within(x + 5, y + 17, width - 9, data.id().substr(data.id().rfind('/') + 1),
                    {.size = 10.5, .colour = data.exists() ? "white" : kText});
    svg.close();
    x += width;
  }
  const std::string load = one.products().empty()
                               ? "nothing to send"
                               : bytes_text(one.bytes()) + " in " + duration_text(seconds(one.takes_us())) +
                                     " of " + duration_text(window_s(one));
  svg.text(kNames + kBars + 16, y + 11, load,
           {.size = 11, .colour = one.products().empty() ? kFaint : kText});
  if (!one.products().empty())
    svg.text(kNames + kBars + 16, y + 25,
             std::to_string(one.products().size()) +
                 (one.products().size() == 1 ? " product, " : " products, ") + joules_text(one.energy_j()),
             {.size = 10.5, .colour = kFaint});
  return y + kDownlink;
}

double draw_unsent(Svg& svg, const std::string& title, const std::vector<v1::UnsentProduct>& list, double y) {
  if (list.empty()) return y;
  svg.line({24, y}, {kPage - 24, y}, {.stroke = kRule});
  svg.text(24, y + 24, title + " (" + std::to_string(list.size()) + ")", {.size = 13, .bold = true});
  y += 38;
  for (std::size_t i = 0; i < std::min(list.size(), kMostRows); ++i) {
    const v1::ScheduledProduct& data = list[i].data();
    svg.rectangle(24, y + 2, 10, 10, {.fill = colour_of(data.tier()), .opacity = data.exists() ? 1.0 : 0.6},
                  2);
    svg.text_within(42, y + 11, 250, data.id(), {.size = 11.5});
    svg.text(360, y + 11, bytes_text(data.bytes()), {.size = 11, .colour = kFaint, .anchor = "end"});
    const std::vector<std::string> why = lines_of(list[i].why(), 86);
    for (std::size_t line = 0; line < std::max<std::size_t>(1, why.size()); ++line) {
      if (line < why.size()) svg.text_within(380, y + 11, kPage - 404, why[line], {.size = 11});
      y += line + 1 < why.size() ? 14 : 20;
    }
  }
  if (list.size() > kMostRows) {
    svg.text(42, y + 11, "and " + std::to_string(list.size() - kMostRows) + " more", {.size = 11});
    y += 20;
  }
  return y + 8;
}

void draw_legend(Svg& svg, double y) {
  double x = kNames;
  for (const v1::DataTier tier :
       {v1::TIER_CRITICAL, v1::TIER_DECISIONAL, v1::TIER_MANDATORY, v1::TIER_RESIDUAL}) {
    svg.rectangle(x, y, 10, 10, {.fill = colour_of(tier)}, 2);
    svg.text(x + 15, y + 9.5, name_of(tier), {.size = 11});
    x += 34 + width_of(name_of(tier), 11);
  }
  svg.rectangle(x, y, 10, 10, {.fill = kBlue, .opacity = 0.6}, 2);
  svg.text(x + 15, y + 9.5, "paler: still to be generated", {.size = 11});
  x += 34 + width_of("paler: still to be generated", 11);
  svg.rectangle(x, y, 10, 10, {.fill = kPale, .stroke = kRule}, 2);
  svg.text(x + 15, y + 9.5, "window, longer than needed", {.size = 11});
}

}  // namespace

std::string downlinks_text(const v1::DownlinkSchedule& schedule) {
  std::string out = printable("Downlink schedule " + made_text(schedule)) + "\n";
  if (!schedule.limited())
    return out + "The network names no rate of its downlinks: all data get home, nothing is scheduled.\n";
  std::vector<std::vector<std::string>> rows{
      {"START", "END", "TAKES", "BYTES", "ENERGY", "TIER", "WHAT", ""}};
  for (const v1::ScheduledDownlink& one : schedule.downlinks()) {
    rows.push_back({lib::clock_text(one.start_us()), lib::clock_text(one.end_us()),
                    duration_text(seconds(one.takes_us())), std::to_string(one.bytes()),
                    joules_text(one.energy_j()), "", one.activity(), ""});
    for (const v1::ScheduledProduct& data : one.products())
      rows.push_back({"", "", "", std::to_string(data.bytes()), "", name_of(data.tier()), "  " + data.id(),
                      whether_planned(data)});
  }
  out += schedule.downlinks().empty() ? "No downlink is planned.\n" : "\n" + table_text(rows);
  add_unsent(out, "LEFT OUT", schedule.left_out());
  add_unsent(out, "LATE", schedule.late());
  if (schedule.omitted() > 0)
    out += "\n" + std::to_string(schedule.omitted()) + " more had no room in the message.\n";
  return out;
}

json downlinks_json(const v1::DownlinkSchedule& schedule) {
  json out = made_json(schedule);
  out["limited"] = schedule.limited();
  out["ranks"] = json::array();
  for (const v1::UtilityRank& rank : schedule.ranks())
    out["ranks"].push_back({{"name", rank.name()}, {"meaning", rank.meaning()}});
  out["downlinks"] = json::array();
  for (const v1::ScheduledDownlink& one : schedule.downlinks()) {
    json products = json::array();
    for (const v1::ScheduledProduct& data : one.products()) products.push_back(to_json(data));
    out["downlinks"].push_back({{"activity", one.activity()},
                                {"start_s", seconds(one.start_us())},
                                {"end_s", seconds(one.end_us())},
                                {"bytes", one.bytes()},
                                {"takes_s", seconds(one.takes_us())},
                                {"energy_j", one.energy_j()},
                                {"products", products}});
  }
  out["left_out"] = to_json(schedule.left_out());
  out["late"] = to_json(schedule.late());
  return out;
}

std::string downlinks_svg(const v1::DownlinkSchedule& schedule) {
  Svg svg;
  draw_title(svg, "Downlink schedule", "Version " + made_text(schedule));
  double y = kTop;
  if (!schedule.limited()) {
    svg.text(24, y + 14,
             "The network names no rate of its downlinks: all data get home, nothing is scheduled.");
    return svg.document(kPage, y + 40, "Downlink schedule");
  }
  draw_legend(svg, y);
  y += 30;
  double longest_s = 1e-6;
  for (const v1::ScheduledDownlink& one : schedule.downlinks())
    longest_s = std::max(longest_s, window_s(one));
  const std::size_t shown = std::min(schedule.downlinks().size(), kMostRows);
  for (std::size_t i = 0; i < shown; ++i) y = draw_downlink(svg, schedule.downlinks()[i], longest_s, y);
  if (schedule.downlinks().size() > shown) {
    svg.text(24, y + 11, "and " + std::to_string(schedule.downlinks().size() - shown) + " more downlinks");
    y += kDownlink;
  }
  if (schedule.downlinks().empty()) {
    svg.text(24, y + 11, "No downlink is planned.");
    y += kDownlink;
  }
  y = draw_unsent(svg, "Left out", schedule.left_out(), y + 6);
  y = draw_unsent(svg, "Late", schedule.late(), y + 4);
  if (schedule.left_out().empty() && schedule.late().empty()) {
    svg.text(24, y + 11, "Nothing is left out, nothing is late.", {.size = 11, .colour = kFaint});
    y += 22;
  }
  return svg.document(kPage, y + 12, "Downlink schedule");
}

}  // namespace roci::console::cli::outlook
