#include "ground_console/cli/map/draw_map.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>

#include "ground_console/cli/map/layers.hpp"

namespace roci::console::cli::map {
namespace {

constexpr double kMargin = 28, kTitle = 58, kAxis = 52, kLegend = 250, kLetter = 2;

bool has_unknown(const terrain::Site& site) {
  return std::ranges::find(site.layers().occupancy, terrain::Occupancy::unknown) !=
         site.layers().occupancy.end();
}

// A hazard may be smaller than a pixel: its mark is never.
void draw_hazards(const MissionMap& map, const Scale& scale, Picture& picture) {
  for (const Circle& hazard : map.hazards) {
    const Spot s = scale.spot(hazard.centre);
    const double radius = std::max(6.0, scale.pixels(hazard.radius));
    picture.disc(s, radius, kHazard, 0.55);
    picture.ring(s, radius, 2.5, kHazard);
    const double arm = std::min(radius, 7.0) * 0.55;
    picture.line({s.x - arm, s.y - arm}, {s.x + arm, s.y + arm}, 2, kRim);
    picture.line({s.x - arm, s.y + arm}, {s.x + arm, s.y - arm}, 2, kRim);
  }
}

void draw_driven(const Way& way, const Scale& scale, Picture& picture) {
  for (const auto& [width, colour] : {std::pair{7.0, kRim}, std::pair{4.0, kDriven}}) {
    for (std::size_t i = 1; i < way.size(); ++i)
      picture.line(scale.spot(way[i - 1]), scale.spot(way[i]), width, colour);
  }
}

void draw_start(Spot s, Picture& picture) {
  picture.disc(s, 6.5, kRim);
  picture.ring(s, 4, 2.5, kDriven);
}

void draw_planned(const Way& way, double width, double dash, const Scale& scale, Picture& picture) {
  for (std::size_t i = 1; i < way.size(); ++i)
    picture.line(scale.spot(way[i - 1]), scale.spot(way[i]), width + 3, kRim, 0.55);
  double done = 0;
  for (std::size_t i = 1; i < way.size(); ++i)
    done = picture.dashes(scale.spot(way[i - 1]), scale.spot(way[i]), width, dash, kPlanned, done);
}

void draw_robot(Spot s, Picture& picture) {
  picture.disc(s, 10, kRim);
  picture.disc(s, 7.5, kDriven);
  picture.disc(s, 3, kRim);
}

void draw_place(Spot s, Picture& picture) {
  picture.disc(s, 6.5, kRim);
  picture.disc(s, 4.5, kPlace);
}

bool overlap(const Frame& a, const Frame& b) {
  return a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
}

// Each name goes to the first of eight sides of its place where it covers no other name or place.
void draw_names(const MissionMap& map, const Scale& scale, Picture& picture) {
  std::vector<Frame> taken;
  for (const NamedPlace& place : map.places) {
    const Spot s = scale.spot(place.at);
    taken.push_back({s.x - 8, s.y - 8, s.x + 8, s.y + 8});
  }
  for (const auto& [robot, way] : map.driven) {
    const Spot s = scale.spot(way.back());
    taken.push_back({s.x - 10, s.y - 10, s.x + 10, s.y + 10});
  }
  const auto put = [&](const std::string& name, Spot s, Colour colour) {
    const double width = Picture::text_width(name, kLetter), height = 8 * kLetter;
    const double gap = 15, diagonal = 13;
    const std::vector<Spot> corners{{s.x + gap, s.y - height / 2},
                                    {s.x - gap - width, s.y - height / 2},
                                    {s.x - width / 2, s.y - gap - height},
                                    {s.x - width / 2, s.y + gap},
                                    {s.x + diagonal, s.y - diagonal - height},
                                    {s.x + diagonal, s.y + diagonal},
                                    {s.x - diagonal - width, s.y - diagonal - height},
                                    {s.x - diagonal - width, s.y + diagonal}};
    const auto frame_at = [&](Spot c) { return Frame{c.x - 3, c.y - 3, c.x + width + 3, c.y + height + 3}; };
    const auto fits = [&](Spot c) {
      const Frame f = frame_at(c), &all = scale.frame();
      return f.left >= all.left && f.right <= all.right && f.top >= all.top && f.bottom <= all.bottom &&
             std::ranges::none_of(taken, [&](const Frame& other) { return overlap(f, other); });
    };
    const auto free = std::ranges::find_if(corners, fits);
    const Spot corner = free == corners.end() ? corners.front() : *free;
    taken.push_back(frame_at(corner));
    picture.text(corner, name, kLetter, colour, true);
  };
  for (const NamedPlace& place : map.places) put(place.name, scale.spot(place.at), kInk);
  for (const auto& [robot, way] : map.driven) put(robot, scale.spot(way.back()), kDriven);
}

std::string number_text(double number) {
  char text[32];
  std::snprintf(text, sizeof text, "%.10g", number);
  return text;
}

void draw_axes(const Scale& scale, Picture& picture) {
  const Frame& f = scale.frame();
  const terrain::Grid& grid = scale.grid();
  const double step = round_length(std::max(grid.width(), grid.height()) / 4);
  for (double x = std::ceil(grid.origin.x / step) * step; x <= grid.origin.x + grid.width(); x += step) {
    const Spot s = scale.spot({x, grid.origin.y});
    const std::string label = number_text(x);
    picture.line({s.x, f.bottom}, {s.x, f.bottom + 7}, 1.5, kFrame);
    picture.text({s.x - Picture::text_width(label, 1.7) / 2, f.bottom + 11}, label, 1.7, kQuiet);
  }
  for (double y = std::ceil(grid.origin.y / step) * step; y <= grid.origin.y + grid.height(); y += step) {
    const Spot s = scale.spot({grid.origin.x, y});
    const std::string label = number_text(y);
    picture.line({f.left - 7, s.y}, {f.left, s.y}, 1.5, kFrame);
    picture.text({f.left - 11 - Picture::text_width(label, 1.7), s.y - 6}, label, 1.7, kQuiet);
  }
  for (const auto& [a, b] : {std::pair{Spot{f.left, f.top}, Spot{f.right, f.top}},
                             std::pair{Spot{f.right, f.top}, Spot{f.right, f.bottom}},
                             std::pair{Spot{f.right, f.bottom}, Spot{f.left, f.bottom}},
                             std::pair{Spot{f.left, f.bottom}, Spot{f.left, f.top}}})
    picture.line(a, b, 1.5, kFrame);
  picture.text({f.right - Picture::text_width("x, y in m", 1.7), f.bottom + 31}, "x, y in m", 1.7, kQuiet);
}

void draw_scale_bar(const Scale& scale, Spot corner, Picture& picture) {
  const double metres = round_length(std::min((kLegend - 30) / scale.pixels(1), scale.grid().width() / 2));
  const double length = scale.pixels(metres);
  for (int part = 0; part < 4; ++part) {
    picture.fill({corner.x + length * part / 4, corner.y, corner.x + length * (part + 1) / 4, corner.y + 7},
                 part % 2 == 0 ? kInk : kRim);
  }
  const Spot ends[]{
      corner, {corner.x + length, corner.y}, {corner.x + length, corner.y + 7}, {corner.x, corner.y + 7}};
  for (int i = 0; i < 4; ++i) picture.line(ends[i], ends[(i + 1) % 4], 1.2, kInk);
  picture.text({corner.x - 4, corner.y + 13}, "0", 1.8, kInk);
  const std::string label = number_text(metres) + " m";
  picture.text({corner.x + length - Picture::text_width(label, 1.8) / 2, corner.y + 13}, label, 1.8, kInk);
}

void draw_north(Spot s, Picture& picture) {
  picture.line({s.x, s.y + 44}, {s.x, s.y + 6}, 2.5, kInk);
  picture.line({s.x, s.y + 2}, {s.x - 8, s.y + 18}, 2.5, kInk);
  picture.line({s.x, s.y + 2}, {s.x + 8, s.y + 18}, 2.5, kInk);
  picture.text({s.x - 5, s.y - 18}, "N", kLetter, kInk);
}

// Draws one entry, a sample and its name, and moves on.
class Legend {
 public:
  Legend(Spot corner, Picture& picture) : at_(corner), picture_(picture) {}

  void entry(const std::string& name, const std::function<void(Spot)>& sample) {
    sample({at_.x + 20, at_.y + 8});
    picture_.text({at_.x + 52, at_.y}, name, kLetter, kInk);
    at_.y += 32;
  }
  Spot end() const { return at_; }

 private:
  Spot at_;
  Picture& picture_;
};

void swatch(Spot s, Colour colour, double stripes, double ground, Picture& picture) {
  for_each_pixel({s.x - 18, s.y - 9, s.x + 18, s.y + 9}, [&](int x, int y) {
    picture.mix(x, y, kHigh, 1);
    picture.mix(x, y, colour, hatched(x, y) ? stripes : ground);
  });
}

Spot draw_legend(const MissionMap& map, Spot corner, Picture& picture) {
  Legend legend(corner, picture);
  const Scale sample({1, 1, 1, {0, 0}}, {0, 0, 1, 1});
  const auto way_at = [](Spot s) { return Way{{s.x - 20, 1 - s.y}, {s.x + 20, 1 - s.y}}; };
  if (!map.driven.empty()) {
    legend.entry("driven", [&](Spot s) { draw_driven(way_at(s), sample, picture); });
    legend.entry("start", [&](Spot s) { draw_start(s, picture); });
    legend.entry("robot", [&](Spot s) { draw_robot(s, picture); });
  }
  if (!map.planned.empty())
    legend.entry("planned way", [&](Spot s) { draw_planned(way_at(s), 3.5, 9, sample, picture); });
  if (!map.planned_legs.empty())
    legend.entry("planned places", [&](Spot s) { draw_planned(way_at(s), 2, 4, sample, picture); });
  if (!map.places.empty()) legend.entry("place", [&](Spot s) { draw_place(s, picture); });
  if (!map.hazards.empty()) {
    legend.entry("hazard", [&](Spot s) {
      draw_hazards({map.site, "", "", {}, {{{s.x, 1 - s.y}, 8}}}, sample, picture);
    });
  }
  if (!map.keep_out.empty() || !map.keep_out_discs.empty())
    legend.entry("keep out", [&](Spot s) { swatch(s, kKeepOut, 0.75, 0.18, picture); });
  if (std::ranges::any_of(map.site.layers().rock_height, [](float h) { return h > 0; }))
    legend.entry("rock", [&](Spot s) { swatch(s, kRock, 0.8, 0.8, picture); });
  if (has_unknown(map.site))
    legend.entry("unknown ground", [&](Spot s) { swatch(s, kUnknown, 0.85, 0.35, picture); });
  return legend.end();
}

}  // namespace

Picture draw_map(const MissionMap& map, int side) {
  const terrain::Grid& grid = map.site.grid();
  const double pixels_a_metre = side / std::max(grid.width(), grid.height());
  const double width = std::max(1.0, std::round(grid.width() * pixels_a_metre));
  const double height = std::max(1.0, std::round(grid.height() * pixels_a_metre));
  const Frame frame{kMargin + kAxis, kMargin + kTitle, kMargin + kAxis + width, kMargin + kTitle + height};
  const double legend_left = frame.right + kMargin;
  Picture picture(static_cast<int>(legend_left + kLegend + kMargin),
                  static_cast<int>(std::max(frame.bottom, 620.0) + kAxis + kMargin / 2), kPaper);
  const Scale scale(grid, frame);

  picture.clip(frame);
  draw_ground(map.site, scale, picture);
  draw_zones(map, scale, picture);
  for (const Way& way : map.planned_legs) draw_planned(way, 2, 4, scale, picture);
  for (const Way& way : map.planned) draw_planned(way, 3.5, 9, scale, picture);
  for (const auto& [robot, way] : map.driven) draw_driven(way, scale, picture);
  for (const auto& [robot, way] : map.driven) draw_start(scale.spot(way.front()), picture);
  draw_hazards(map, scale, picture);
  for (const NamedPlace& place : map.places) draw_place(scale.spot(place.at), picture);
  for (const auto& [robot, way] : map.driven) draw_robot(scale.spot(way.back()), picture);
  draw_names(map, scale, picture);
  picture.clip_nothing();

  draw_axes(scale, picture);
  picture.text({frame.left, kMargin - 4}, map.title, 3, kInk);
  picture.text({frame.left, kMargin + 28}, map.subtitle, 1.8, kQuiet);
  const Spot end = draw_legend(map, {legend_left, frame.top + 4}, picture);
  draw_scale_bar(scale, {legend_left + 6, end.y + 26}, picture);
  draw_north({legend_left + 20, end.y + 110}, picture);
  return picture;
}

}  // namespace roci::console::cli::map
