// The science subway map with outcomes (R112; figure 3).
#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <nlohmann/json.hpp>

#include "ground_console/cli/outlook/outlook.hpp"
#include "ground_console/cli/outlook/words.hpp"
#include "ground_console/cli/report.hpp"
#include "ground_console/cli/table.hpp"
#include "ground_console/lib/mission_view.hpp"

namespace roci::console::cli::outlook {
namespace {

using nlohmann::json;

constexpr double kSiteNames = 210;
constexpr double kStations = 150;  // between two of them
constexpr double kTransfer = 78;   // from where sites are joined to the first station
constexpr double kLine = 116;      // between two lines
constexpr std::array kLines{"#2f6db5", "#8e4585", "#b8860b", "#157f7b", "#7a5230", "#566573"};

// Targets of a site go by their weight, equal ones in the order of the network.
std::vector<const v1::SubwayTarget*> in_order(const v1::SubwaySite& site) {
  std::vector<const v1::SubwayTarget*> out;
  for (const v1::SubwayTarget& target : site.targets()) out.push_back(&target);
  std::ranges::stable_sort(out, std::greater{}, [](const v1::SubwayTarget* one) {
    return std::isfinite(one->visual()) ? one->visual() : 0.0;
  });
  return out;
}

std::string state_of(const v1::SubwayTarget& target, const std::string& next) {
  if (target.outcome() != v1::SIGNATURE_UNKNOWN) return name_of(target.outcome());
  if (target.planned()) return "planned";
  if (target.task() == next) return "next";
  return target.closed() ? "closed" : "unknown";
}

std::string where_to(const v1::MissionOutlook& outlook) {
  if (outlook.sites().empty()) return "This mission has no subway map.";
  return outlook.next_target().empty()
             ? "After what is planned the line ends."
             : "After what is planned the map leads to " + outlook.next_target() + ".";
}

void draw_station(Svg& svg, const v1::SubwayTarget& target, const std::string& state, const char* colour,
                  double x, double y) {
  if (state == "planned") svg.circle(x, y, 20, {.stroke = colour, .width = 2, .dashes = "4 3"});
  if (state == "next") {
    svg.polygon({{x - 8, y - 34}, {x + 8, y - 34}, {x, y - 21}}, {.fill = kText});
    svg.text(x, y - 39, "next", {.size = 11, .anchor = "middle", .bold = true});
  }
  const bool positive = target.outcome() == v1::SIGNATURE_POSITIVE;
  const bool negative = target.outcome() == v1::SIGNATURE_NEGATIVE;
  const bool closed = state == "closed";
  svg.circle(x, y, 14,
             {.fill = positive   ? kGreen
                      : negative ? kRed
                                 : "white",
              .stroke = positive   ? kGreen
                        : negative ? kRed
                        : closed   ? "#aab3bd"
                                   : colour,
              .width = 4});
  if (positive || negative) svg.line({x - 7, y}, {x + 7, y}, {.stroke = "white", .width = 3});
  if (positive) svg.line({x, y - 7}, {x, y + 7}, {.stroke = "white", .width = 3});
  if (closed) {
    svg.line({x - 5, y - 5}, {x + 5, y + 5}, {.stroke = "#aab3bd", .width = 2.5});
    svg.line({x - 5, y + 5}, {x + 5, y - 5}, {.stroke = "#aab3bd", .width = 2.5});
  }
  svg.text_within(x, y + 33, kStations - 12, target.task(), {.size = 11, .anchor = "middle"});
  svg.text(x, y + 47, "value " + lib::value_text(std::round(target.estimated() * 100) / 100),
           {.size = 10.5, .colour = kFaint, .anchor = "middle"});
}

void draw_key(Svg& svg, double y) {
  double x = 32;
  const auto word = [&](const char* words) {
    svg.text(x + 14, y + 4, words, {.size = 11});
    x += 42 + width_of(words, 11);
  };
  svg.circle(x, y, 7, {.fill = kGreen});
  word("positive signature");
  svg.circle(x, y, 7, {.fill = kRed});
  word("negative");
  svg.circle(x, y, 6, {.fill = "white", .stroke = kBlue, .width = 3});
  word("not sampled");
  svg.circle(x, y, 4, {.fill = "white", .stroke = kBlue, .width = 2});
  svg.circle(x, y, 8, {.stroke = kBlue, .width = 1.5, .dashes = "3 2"});
  word("sample planned");
  svg.circle(x, y, 6, {.fill = "white", .stroke = "#aab3bd", .width = 3});
  word("closed: nobody asks for it");
}

}  // namespace

std::string subway_text(const v1::MissionOutlook& outlook) {
  std::string out =
      printable("Subway map " + made_text(outlook)) + "\n" + printable(where_to(outlook)) + "\n";
  if (outlook.sites().empty()) return out;
  out += "At most " + std::to_string(outlook.most_samples()) +
         " samples at a site, until the first negative one.\n\n";
  std::vector<std::vector<std::string>> rows{{"SITE", "CHANCE", "BY VISION", "TARGET", "VALUE", "STATE"}};
  for (const v1::SubwaySite& site : outlook.sites()) {
    bool first = true;
    for (const v1::SubwayTarget* const target : in_order(site)) {
      rows.push_back({first ? site.name() : "", first ? lib::value_text(site.chance()) : "",
                      first ? lib::value_text(site.by_vision()) : "", target->task(),
                      lib::value_text(target->estimated()), state_of(*target, outlook.next_target())});
      first = false;
    }
  }
  return out + table_text(rows);
}

json subway_json(const v1::MissionOutlook& outlook) {
  json out = made_json(outlook);
  out["most_samples"] = outlook.most_samples();
  out["next_target"] = outlook.next_target();
  out["sites"] = json::array();
  for (const v1::SubwaySite& site : outlook.sites()) {
    json targets = json::array();
    for (const v1::SubwayTarget& target : site.targets())
      targets.push_back({{"task", target.task()},
                         {"outcome", name_of(target.outcome())},
                         {"visual", target.visual()},
                         {"estimated", target.estimated()},
                         {"planned", target.planned()},
                         {"closed", target.closed()},
                         {"state", state_of(target, outlook.next_target())}});
    out["sites"].push_back({{"name", site.name()},
                            {"by_vision", site.by_vision()},
                            {"chance", site.chance()},
                            {"targets", targets}});
  }
  return out;
}

std::string subway_svg(const v1::MissionOutlook& outlook) {
  Svg svg;
  draw_title(svg, "Science subway map", "Version " + made_text(outlook));
  std::size_t most = 3;
  const std::size_t shown = std::min(outlook.sites().size(), kMostRows);
  for (std::size_t i = 0; i < shown; ++i) most = std::max(most, outlook.sites()[i].targets().size());
  most = std::min(most, kMostRows);
  const double width = std::max(760.0, kSiteNames + kStations * static_cast<double>(most) + 10);
  if (!outlook.sites().empty()) draw_key(svg, kTop + 8);
  double y = kTop + 78;
  const double first_x = kSiteNames + 60;
  for (std::size_t i = 0; i < shown; ++i, y += kLine) {
    const v1::SubwaySite& site = outlook.sites()[i];
    const char* const colour = kLines[i % kLines.size()];
    const auto stations = in_order(site);
    const double last_x =
        first_x +
        kStations * static_cast<double>(std::max<std::size_t>(1, std::min(stations.size(), most)) - 1);
    if (i + 1 < shown)  // the transfer to the site of the next chance
      svg.polyline({{first_x - kTransfer, y}, {first_x - kTransfer, y + kLine}},
                   {.stroke = "#b9c1ca", .width = 3, .dashes = "2 5"});
    // Behind the first negative signature, and what was sampled all the same, nobody goes on.
    double end_x = last_x;
    if (std::ranges::any_of(stations,
                            [](const auto* one) { return one->outcome() == v1::SIGNATURE_NEGATIVE; })) {
      end_x = first_x;
      for (std::size_t s = 0; s < std::min(stations.size(), most); ++s)
        if (stations[s]->outcome() != v1::SIGNATURE_UNKNOWN || stations[s]->planned())
          end_x = first_x + kStations * static_cast<double>(s);
    }
    svg.line({end_x, y}, {last_x, y}, {.stroke = kRule, .width = 7});
    svg.line({first_x - kTransfer, y}, {end_x, y}, {.stroke = colour, .width = 7});
    svg.circle(first_x - kTransfer, y, 6, {.fill = "white", .stroke = "#8a97a6", .width = 3});
    svg.text_within(24, y - 4, kSiteNames - 50, site.name(), {.size = 14, .colour = colour, .bold = true});
    svg.text(24, y + 12, "chance " + lib::value_text(std::round(site.chance() * 100) / 100),
             {.size = 11, .colour = kText});
    svg.text(24, y + 26, "by vision " + lib::value_text(std::round(site.by_vision() * 100) / 100),
             {.size = 11, .colour = kFaint});
    for (std::size_t s = 0; s < std::min(stations.size(), most); ++s)
      draw_station(svg, *stations[s], state_of(*stations[s], outlook.next_target()), colour,
                   first_x + kStations * static_cast<double>(s), y);
  }
  if (outlook.sites().empty()) y = kTop + 14;
  svg.text(24, y - 20, where_to(outlook), {.size = 12, .bold = true});
  if (!outlook.sites().empty())
    svg.text(24, y - 3,
             "Sites from the greatest chance down; at most " + std::to_string(outlook.most_samples()) +
                 " samples at each, until its first negative one." +
                 (outlook.sites().size() > shown ? " Not all sites are drawn." : ""),
             {.size = 11, .colour = kFaint});
  return svg.document(width, y + 16, "Science subway map");
}

}  // namespace roci::console::cli::outlook
