#include "science_svc/detector.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <utility>

#include "science_svc/limits.hpp"

namespace roci::science {

using terrain::Point;

namespace {

constexpr double kFarthestId = 1e8;  // m, of a place that an id can say: more than any map projection has

constexpr std::size_t kTeachers = 3;
constexpr double kEdge = 0.8;  // share of the threshold down to which a region goes on

bool touch(const Window& a, const Window& b) {
  return a.left <= b.left + b.width && b.left <= a.left + a.width && a.top <= b.top + b.height &&
         b.top <= a.top + a.height;
}

// Grows from the first open patch over all that touch, and takes them out of `open`.
std::vector<std::size_t> take_region(std::vector<std::size_t>& open, const std::vector<Patch>& patches) {
  std::vector<std::size_t> region{open.front()};
  open.erase(open.begin());
  for (std::size_t next = 0; next < region.size(); ++next) {
    std::erase_if(open, [&](std::size_t other) {
      if (!touch(patches[region[next]].window, patches[other].window)) return false;
      region.push_back(other);
      return true;
    });
  }
  return region;
}

// Returns the window around all patches of a region.
Window around(const std::vector<std::size_t>& region, const std::vector<Patch>& patches) {
  int left = 1 << 20, top = 1 << 20, right = 0, bottom = 0;
  for (const std::size_t i : region) {
    const Window& w = patches[i].window;
    left = std::min(left, w.left);
    top = std::min(top, w.top);
    right = std::max(right, w.left + w.width);
    bottom = std::max(bottom, w.top + w.height);
  }
  return {left, top, right - left, bottom - top};
}

}  // namespace

std::string find_id(Point p) {
  const auto metres = [](double v) { return std::llround(std::clamp(v, -kFarthestId, kFarthestId)); };
  const long long east = metres(p.x), north = metres(p.y);
  return "find-" + std::string(east < 0 ? "w" : "e") + std::to_string(std::llabs(east)) +
         (north < 0 ? "s" : "n") + std::to_string(std::llabs(north));
}

std::optional<Point> place_of(const std::string& id) {
  char east = 0, north = 0;
  long x = 0, y = 0;
  int used = 0;
  if (id.size() > 32 || std::sscanf(id.c_str(), "find-%c%9ld%c%9ld%n", &east, &x, &north, &y, &used) != 4)
    return std::nullopt;
  if (static_cast<std::size_t>(used) != id.size()) return std::nullopt;
  const Point out{static_cast<double>(east == 'w' ? -x : x), static_cast<double>(north == 's' ? -y : y)};
  return find_id(out) == id ? std::optional(out) : std::nullopt;
}

Detector::Detector(DetectorSettings settings, std::shared_ptr<const terrain::Site> site)
    : settings_(std::move(settings)), site_(std::move(site)) {}

bool Detector::full() const { return seen_.size() >= kPhotos; }

std::vector<Patch> Detector::patches(const Photo& photo) const {
  return patches_of(photo.pixels, settings_.camera, photo.from, MappedGround{site_.get()}, settings_.reach_m);
}

// Takes the photo's id in; false for one that is not to be looked at, or was.
bool Detector::is_new(const Photo& photo) {
  const Viewpoint& from = photo.from;
  const bool placed = std::isfinite(from.heading) && std::isfinite(from.at.x) && std::isfinite(from.at.y) &&
                      std::hypot(from.at.x, from.at.y) < kFarthestId &&
                      MappedGround{site_.get()}.contains(from.at);
  return settings_.enabled && placed && !full() && photo.id.size() <= kNameBytes &&
         seen_.insert(photo.id).second;
}

void Detector::learn(const Photo& photo) {
  if (is_new(photo)) background_.learn(patches(photo));
}

std::vector<Candidate> Detector::candidates(const Photo& photo, double threshold) {
  const std::vector<Patch> patches = this->patches(photo);
  // An image is compared with earlier ones alone, so that what fills much of it does not hide itself; but with itself,
  // too, while there are few.
  const bool few = background_.images() < kTeachers;
  if (few) background_.learn(patches);
  const std::vector<double> scores = background_.scores(patches);
  if (!few) background_.learn(patches);
  std::vector<std::size_t> odd;
  for (std::size_t i = 0; i < patches.size(); ++i)
    if (scores[i] >= kEdge * threshold) odd.push_back(i);
  std::vector<Candidate> out;
  while (!odd.empty()) {
    const std::vector<std::size_t> region = take_region(odd, patches);
    const auto oddest = *std::ranges::max_element(region, {}, [&](std::size_t i) { return scores[i]; });
    if (scores[oddest] >= threshold)
      out.push_back({patches[oddest].ground, scores[oddest], around(region, patches)});
  }
  std::ranges::stable_sort(out, std::ranges::greater{}, &Candidate::score);
  return out;
}

bool Detector::known(Point place) const {
  return std::ranges::any_of(
             finds_, [&](Point earlier) { return terrain::distance(earlier, place) <= settings_.merge_m; }) ||
         find_ids_.contains(find_id(place));
}

std::vector<Find> Detector::look(const Photo& photo, temporal::Time now) {
  std::vector<Find> out;
  const MappedGround ground{site_.get()};
  if (!is_new(photo)) return out;
  for (const Candidate& one : candidates(photo, settings_.threshold)) {
    if (find_ids_.size() >= static_cast<std::size_t>(settings_.limit)) break;
    if (last_find_ && now - *last_find_ < settings_.min_interval) break;
    const Point place{std::round(one.place.x) + 0.0, std::round(one.place.y) + 0.0};  // no -0
    if (!ground.contains(place) || known(place)) continue;
    out.push_back({find_id(place), place, one.score, cut(photo.pixels, one.window)});
    remember(out.back().id, now);
  }
  return out;
}

void Detector::remember(const std::string& id, temporal::Time now) {
  const auto place = place_of(id);
  if (!place || find_ids_.size() >= kPhotos || !find_ids_.insert(id).second) return;
  finds_.push_back(*place);
  last_find_ = now;
}

}  // namespace roci::science
