#include "core/terrain/way.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace roci::terrain {
namespace {

void append(std::string& out, double number) {
  char text[32];
  out.append(text, std::to_chars(text, text + sizeof text, number).ptr);
}

std::optional<double> number_in(std::string_view text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return {};
  return number;
}

std::optional<Point> point_in(std::string_view text) {
  const std::size_t comma = text.find(',');
  if (comma == std::string_view::npos) return {};
  const auto x = number_in(text.substr(0, comma)), y = number_in(text.substr(comma + 1));
  if (!x || !y) return {};
  return Point{*x, *y};
}

}  // namespace

std::string to_text(const Way& way) {
  std::string out;
  for (const Point& point : way) {
    if (!out.empty()) out += ';';
    append(out, point.x);
    out += ',';
    append(out, point.y);
  }
  return out;
}

WayInText read_way(std::string_view text, std::size_t most) {
  const auto points = static_cast<std::size_t>(std::ranges::count(text, ';')) + 1;
  if (points > most)
    return {{}, "it has " + std::to_string(points) + " points; a way has at most " + std::to_string(most)};
  WayInText out;
  while (true) {
    const std::size_t end = text.find(';');
    const auto point = point_in(text.substr(0, end));
    if (!point)
      return {{},
              "point " + std::to_string(out.way.size() + 1) + " is not 'x,y' with finite numbers in metres"};
    out.way.push_back(*point);
    if (end == std::string_view::npos) return out;
    text.remove_prefix(end + 1);
  }
}

Way cut_short(Way way, double metres) {
  while (way.size() > 1 && metres > 0) {
    const Point end = way.back();
    way.pop_back();
    const double leg = distance(way.back(), end);
    if (leg > metres) {
      const double share = metres / leg;
      way.push_back({end.x + (way.back().x - end.x) * share, end.y + (way.back().y - end.y) * share});
      return way;
    }
    metres -= leg;
  }
  return way;
}

double heading_at_end(const Way& way, double otherwise) {
  for (std::size_t i = way.size(); i > 1; --i)
    if (way[i - 1] != way[i - 2]) return std::atan2(way[i - 1].y - way[i - 2].y, way[i - 1].x - way[i - 2].x);
  return otherwise;
}

}  // namespace roci::terrain
