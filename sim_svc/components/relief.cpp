#include "sim_svc/components/relief.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "core/pseudorandom/split_mix.hpp"
#include "core/terrain/lattice_noise.hpp"

namespace roci::sim::components {

using terrain::Point;
using world::Look;

namespace {

constexpr double kPebbleTile = 0.6;  // m, holds one pebble at most
constexpr double kPebbleReach = 9;   // m, beyond which they are too small to be seen
constexpr double kPebbleShare = 0.45;
constexpr double kLeastRock = 0.03;  // m, lower ones are pebbles

// The layers of the soil's texture: length and height of its waves, in m.
struct Ripple {
  double wavelength;
  double height;
};
constexpr std::array<Ripple, 3> kRipples{{{0.9, 0.030}, {0.28, 0.011}, {0.09, 0.0035}}};

double uniform(pseudorandom::SplitMix64& random) {
  return static_cast<double>(random.next() >> 11) * 0x1p-53;
}

pseudorandom::SplitMix64 random_at(std::uint64_t seed, std::int64_t column, std::int64_t row) {
  const std::uint64_t place =
      (static_cast<std::uint64_t>(column) << 32) ^ (static_cast<std::uint64_t>(row) & 0xffffffff);
  return pseudorandom::SplitMix64(pseudorandom::SplitMix64(seed).next() ^ place);
}

std::int64_t floored(double v) { return static_cast<std::int64_t>(std::floor(v)); }

// Returns how much of a wave is left when it is looked at through a footprint.
double seen(double wavelength, double footprint) {
  return std::clamp((wavelength / std::max(footprint, 1e-6) - 1) / 2, 0.0, 1.0);
}

}  // namespace

Relief::Relief(const world::Ground& ground, Point centre, double reach)
    : ground_(ground), centre_(centre), reach_(reach), side_(2 * static_cast<int>(std::ceil(reach)) + 1) {
  bins_.resize(static_cast<std::size_t>(side_) * static_cast<std::size_t>(side_));
  oddities_ = world::oddities_near(ground.surface, centre, reach);
  add_rocks();
  add_pebbles();
  add_oddities();
}

void Relief::add(const Stone& stone) {
  const double wide = stone.radius * (stone.smooth ? 1 : 1.35);  // with the bulges of its outline
  const auto bin = [&](double v, double middle) {
    return std::clamp(static_cast<int>(std::floor(v - middle + side_ / 2.0)), 0, side_ - 1);
  };
  const auto index = static_cast<std::uint32_t>(stones_.size());
  for (int row = bin(stone.at.y - wide, centre_.y); row <= bin(stone.at.y + wide, centre_.y); ++row) {
    for (int column = bin(stone.at.x - wide, centre_.x); column <= bin(stone.at.x + wide, centre_.x);
         ++column)
      bins_[static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) +
            static_cast<std::size_t>(column)]
          .push_back(index);
  }
  stones_.push_back(stone);
  tallest_ = std::max(tallest_, stone.height);
}

void Relief::add_rocks() {
  const terrain::Site& site = *ground_.site;
  const terrain::Grid& grid = site.grid();
  const auto within = [](double v, int count) { return static_cast<int>(std::clamp(v, 0.0, count - 1.0)); };
  const auto column_of = [&](double x) {
    return within((x - grid.origin.x) / grid.resolution, grid.columns);
  };
  const auto row_of = [&](double y) { return within((y - grid.origin.y) / grid.resolution, grid.rows); };
  for (int row = row_of(centre_.y - reach_); row <= row_of(centre_.y + reach_); ++row) {
    for (int column = column_of(centre_.x - reach_); column <= column_of(centre_.x + reach_); ++column) {
      const double height = site.rock_height(terrain::Cell{column, row});
      if (height < kLeastRock) continue;
      pseudorandom::SplitMix64 random = random_at(ground_.surface.seed + 1, column, row);
      const Point middle = grid.centre({column, row});
      const double off = 0.4 * grid.resolution;
      const Point at{middle.x + off * (uniform(random) - 0.5), middle.y + off * (uniform(random) - 0.5)};
      const double radius = std::clamp(height, 0.1, 0.8 * grid.resolution);
      add({at, radius, height, 0.24 + 0.2 * uniform(random)});
    }
  }
  for (const world::Rock& rock : ground_.hidden_rocks) {
    const Point at{rock.x, rock.y};
    if (terrain::distance(at, centre_) <= reach_) add({at, rock.radius, 0.8 * rock.radius, 0.3});
  }
}

void Relief::add_pebbles() {
  const double reach = std::min(reach_, kPebbleReach);
  for (std::int64_t row = floored((centre_.y - reach) / kPebbleTile);
       row <= floored((centre_.y + reach) / kPebbleTile); ++row) {
    for (std::int64_t column = floored((centre_.x - reach) / kPebbleTile);
         column <= floored((centre_.x + reach) / kPebbleTile); ++column) {
      pseudorandom::SplitMix64 random = random_at(ground_.surface.seed + 2, column, row);
      if (uniform(random) >= kPebbleShare) continue;
      // Few are large: the size falls with the power of the draw.
      const double radius = 0.02 + 0.1 * std::pow(uniform(random), 3);
      const Point at{(static_cast<double>(column) + 0.2 + 0.6 * uniform(random)) * kPebbleTile,
                     (static_cast<double>(row) + 0.2 + 0.6 * uniform(random)) * kPebbleTile};
      add({at, radius, 0.8 * radius, 0.26 + 0.2 * uniform(random)});
    }
  }
}

void Relief::add_oddities() {
  for (const world::Oddity& one : oddities_) {
    if (one.look == Look::dark) add({{one.x, one.y}, one.radius, 0.3 * one.radius, 0.07, 0, true});
    if (one.look == Look::layered) add({{one.x, one.y}, one.radius, 0.3 * one.radius, 0.4, 4});
  }
}

const std::vector<std::uint32_t>* Relief::stones_at(Point p) const {
  const int column = static_cast<int>(std::floor(p.x - centre_.x + side_ / 2.0));
  const int row = static_cast<int>(std::floor(p.y - centre_.y + side_ / 2.0));
  if (column < 0 || row < 0 || column >= side_ || row >= side_) return nullptr;
  return &bins_[static_cast<std::size_t>(row) * static_cast<std::size_t>(side_) +
                static_cast<std::size_t>(column)];
}

double Relief::noise(std::uint64_t salt, Point p, double wavelength) const {
  constexpr std::int64_t kOne = 1 << 16;
  const auto fine = [](double v) { return static_cast<std::int64_t>(std::llround(v * 1000)); };
  const auto length = std::max<std::int64_t>(fine(wavelength), 2);
  return static_cast<double>(
             terrain::lattice_noise(ground_.surface.seed + salt, fine(p.x), fine(p.y), length, kOne)) /
         kOne;
}

// Returns how high the stone stands above the ground at a point, in m.
double Relief::rise(const Stone& stone, Point p) const {
  double share = terrain::distance(p, stone.at) / stone.radius;
  if (share >= 1.35) return 0;
  if (!stone.smooth) share *= 1 + 0.3 * noise(3, p, 0.7 * stone.radius);
  if (share >= 1) return 0;
  double dome = std::sqrt(1 - share * share);
  if (stone.steps > 0) dome = std::ceil(dome * stone.steps) / stone.steps;
  return stone.height * dome;
}

double Relief::height(Point p) const {
  double above = 0;
  if (const auto* near = stones_at(p))
    for (const std::uint32_t index : *near) above = std::max(above, rise(stones_[index], p));
  return floor(p) + above;
}

const Relief::Stone* Relief::top_at(Point p) const {
  const Stone* top = nullptr;
  double above = 0;
  if (const auto* near = stones_at(p)) {
    for (const std::uint32_t index : *near) {
      const double rises = rise(stones_[index], p);
      if (rises <= above) continue;
      above = rises;
      top = &stones_[index];
    }
  }
  return top;
}

// Returns the height of the soil's ripples in m.
double Relief::soil(Point p, double footprint) const {
  double out = 0;
  for (std::size_t i = 0; i < kRipples.size(); ++i) {
    const double left = seen(kRipples[i].wavelength, footprint);
    if (left > 0) out += left * kRipples[i].height * noise(10 + i, p, kRipples[i].wavelength);
  }
  return out;
}

double Relief::albedo(Point p, double footprint, const Stone* top) const {
  double out = kSoilAlbedo * (1 + 0.1 * noise(20, p, 4) + 0.06 * seen(0.5, footprint) * noise(21, p, 0.5));
  if (top) out = top->albedo * (top->smooth ? 1 : 1 + 0.25 * seen(0.12, footprint) * noise(22, p, 0.12));
  for (const world::Oddity& one : oddities_) {
    const double far = terrain::distance(p, {one.x, one.y});
    if (far > 1.4 * one.radius || far * (1 + 0.3 * noise(23, p, 0.6)) > one.radius) continue;
    if (one.look == Look::bright && !top) out = 0.88 * (1 + 0.05 * noise(24, p, 0.2));
    if (one.look == Look::layered && top && top->steps > 0) {
      const double turn = noise(25, {one.x, one.y}, 1) * std::numbers::pi;
      const double along = p.x * std::cos(turn) + p.y * std::sin(turn) + 0.03 * noise(26, p, 0.4);
      const double band = std::sin(2 * std::numbers::pi * along / 0.34) > 0 ? 0.62 : 0.22;
      out = 0.42 + (band - 0.42) * seen(0.34, footprint / 2);
    }
    if (one.look == Look::spotted && !top) {
      const double dots = noise(27, p, 0.16);
      out = dots > 0.25 ? 0.85 : 0.3;
      out = 0.5 + (out - 0.5) * seen(0.2, footprint / 2);
    }
  }
  return out;
}

Relief::Spot Relief::spot(Point p, double footprint) const {
  const Stone* top = top_at(p);
  const double step = std::clamp(footprint / 2, 0.01, 0.2);
  const bool smooth = top && top->smooth;
  const auto surface = [&](Point q) { return height(q) + (smooth ? 0 : soil(q, footprint)); };
  const double here = surface(p);
  // Forward differences: a pixel on an edge belongs to either side.
  const terrain::Gradient slope{(surface({p.x + step, p.y}) - here) / step,
                                (surface({p.x, p.y + step}) - here) / step};
  return {slope, albedo(p, footprint, top)};
}

}  // namespace roci::sim::components
