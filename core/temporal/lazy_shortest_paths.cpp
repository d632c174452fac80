#include "core/temporal/lazy_shortest_paths.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace roci::temporal {
namespace {

// One search may go through so many points before all values are computed at once.
constexpr std::size_t kLongSearch = 128;

/// Groups the indices of the edges by one of their ends: those of point p stand at [begin[p], begin[p + 1]).
template <typename EndOf>
void group(const std::vector<LazyShortestPaths::Edge>& edges, std::size_t point_count, EndOf end_of,
           std::vector<std::uint32_t>& begin, std::vector<std::uint32_t>& grouped) {
  begin.assign(point_count + 1, 0);
  for (const auto& edge : edges) ++begin[end_of(edge) + 1];
  for (std::size_t p = 0; p < point_count; ++p) begin[p + 1] += begin[p];
  grouped.resize(edges.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t e = 0; e < edges.size(); ++e) grouped[next[end_of(edges[e])]++] = e;
}

template <typename Heap>
void push(Heap& heap, Duration key, TimePoint point) {
  heap.emplace_back(key, point);
  std::push_heap(heap.begin(), heap.end(), std::greater<>{});
}

template <typename Heap>
auto pop(Heap& heap) {
  std::pop_heap(heap.begin(), heap.end(), std::greater<>{});
  const auto entry = heap.back();
  heap.pop_back();
  return entry;
}

}  // namespace

LazyShortestPaths::LazyShortestPaths(std::vector<Edge> edges, std::vector<Duration> potential)
    : edges_(std::move(edges)),
      first_potential_(std::move(potential)),
      fixed_(first_potential_.size(), 0),
      potential_(first_potential_),
      value_(potential_.size(), no_bound),
      known_(potential_.size(), 1),
      passed_(potential_.size(), 0),
      sure_above_(potential_.size(), -no_bound),
      distance_(potential_.size(), no_bound) {
  group(
      edges_, potential_.size(), [](const Edge& e) { return e.tail; }, out_begin_, out_);
  group(
      edges_, potential_.size(), [](const Edge& e) { return e.head; }, in_begin_, in_);
}

Duration LazyShortestPaths::value(TimePoint point) const {
  if (known_[point] == 0 && !search(point)) settle();
  return value_[point];
}

void LazyShortestPaths::fix(TimePoint point, Duration value) {
  changes_.clear();
  rebases_at_fix_ = rebases_;
  const bool was_known = known_[point] != 0;
  const Duration before = value_[point];
  fixed_[point] = known_[point] = 1;
  passed_[point] = 0;
  value_[point] = value;
  if (was_known && before == value) return;
  Duration floor = floor_;
  for (std::uint32_t i = out_begin_[point]; i < out_begin_[point + 1]; ++i) {
    const Edge& edge = edges_[out_[i]];
    ++work_;
    if (fixed_[edge.head] != 0 || !bounded(edge.weight)) continue;
    const Duration through = value + edge.weight;
    const bool gives_none = known_[edge.head] != 0 && through >= value_[edge.head];
    const bool gave_none = was_known && (!bounded(before) || before + edge.weight > value_[edge.head]);
    if (gives_none && gave_none) continue;
    if (!gives_none) floor = std::min(floor, through - potential_[edge.head]);
    forget(edge.head);
  }
  lower_floor(floor);
}

void LazyShortestPaths::undo_fix(TimePoint point) {
  changes_.clear();
  changes_.push_back({point, value_[point]});
  fixed_[point] = known_[point] = 0;
  forget_heads(point);
  if (rebases_ == rebases_at_fix_) return;
  potential_ = first_potential_;  // the newer one need not suit the edges into the point
  settle();
}

void LazyShortestPaths::reweigh(std::uint32_t index, Duration weight) {
  changes_.clear();
  Edge& edge = edges_[index];
  if (edge.weight == weight) return;
  edge.weight = weight;
  if (fixed_[edge.head] != 0) return;
  forget(edge.head);
  if (fixed_[edge.tail] != 0 && bounded(weight))
    lower_floor(std::min(floor_, value_[edge.tail] + weight - potential_[edge.head]));
}

void LazyShortestPaths::cut_off(TimePoint point) {
  changes_.clear();
  forget(point);
  forget_heads(point);
  for (std::uint32_t i = out_begin_[point]; i < out_begin_[point + 1]; ++i) edges_[out_[i]].weight = no_bound;
  for (std::uint32_t i = in_begin_[point]; i < in_begin_[point + 1]; ++i) edges_[in_[i]].weight = no_bound;
}

/// Forgets the value of the point and all known ones that were computed through it.
void LazyShortestPaths::forget(TimePoint root) {
  std::vector<TimePoint> open{root};
  while (!open.empty()) {
    const TimePoint point = open.back();
    open.pop_back();
    if (fixed_[point] != 0 || (known_[point] == 0 && passed_[point] == 0)) continue;
    if (known_[point] != 0) changes_.push_back({point, value_[point]});
    known_[point] = passed_[point] = 0;
    for (std::uint32_t i = out_begin_[point]; i < out_begin_[point + 1]; ++i) {
      ++work_;
      if (bounded(edges_[out_[i]].weight)) open.push_back(edges_[out_[i]].head);
    }
  }
}

void LazyShortestPaths::forget_heads(TimePoint point) {
  for (std::uint32_t i = out_begin_[point]; i < out_begin_[point + 1]; ++i)
    if (bounded(edges_[out_[i]].weight)) forget(edges_[out_[i]].head);
}

/// Known values whose search ended early on the strength of a higher floor may now be smaller.
void LazyShortestPaths::lower_floor(Duration floor) {
  floor_ = floor;
  while (!unsure_.empty() && unsure_.front().first > floor_) {
    std::pop_heap(unsure_.begin(), unsure_.end());
    const auto [sure_above, point] = unsure_.back();
    unsure_.pop_back();
    if (known_[point] != 0 && fixed_[point] == 0 && sure_above_[point] == sure_above) forget(point);
  }
}

/// Makes the value of one point known. Returns false, with nothing changed, if that leads too far.
bool LazyShortestPaths::search(TimePoint target) const {
  std::vector<Entry> heap;
  std::vector<TimePoint> touched{target};
  std::vector<TimePoint> expanded;
  distance_[target] = Duration{0};
  push(heap, Duration{0}, target);
  Duration best = no_bound;  // less the potential of the target
  Duration sure_above = -no_bound;
  while (!heap.empty() && expanded.size() <= kLongSearch) {
    const auto [distance, point] = pop(heap);
    if (distance != distance_[point]) continue;
    if (bounded(best) && distance >= best - floor_) {
      sure_above = best - distance;
      break;
    }
    expanded.push_back(point);
    for (std::uint32_t i = in_begin_[point]; i < in_begin_[point + 1]; ++i) {
      const Edge& edge = edges_[in_[i]];
      ++work_;
      if (!bounded(edge.weight)) continue;
      if (known_[edge.tail] != 0) {
        if (bounded(value_[edge.tail]))
          best = std::min(best, value_[edge.tail] + edge.weight - potential_[point] + distance);
        continue;
      }
      const Duration farther = distance + edge.weight + potential_[edge.tail] - potential_[point];
      if (farther >= distance_[edge.tail]) continue;
      if (!bounded(distance_[edge.tail])) touched.push_back(edge.tail);
      distance_[edge.tail] = farther;
      push(heap, farther, edge.tail);
    }
  }
  for (const TimePoint point : touched) distance_[point] = no_bound;
  if (expanded.size() > kLongSearch) return false;
  for (const TimePoint point : expanded) passed_[point] = 1;
  passed_[target] = 0;
  known_[target] = 1;
  value_[target] = bounded(best) ? best + potential_[target] : no_bound;
  sure_above_[target] = sure_above;
  if (bounded(sure_above)) {
    unsure_.emplace_back(sure_above, target);
    std::push_heap(unsure_.begin(), unsure_.end());
  }
  return true;
}

void LazyShortestPaths::settle() const {
  compute_all();
  rebase();
}

/// Goes forward from all known values (Dijkstra).
void LazyShortestPaths::compute_all() const {
  std::vector<Entry> heap;
  const auto relax = [&](const Edge& edge) {
    ++work_;
    if (known_[edge.head] != 0 || !bounded(edge.weight) || !bounded(value_[edge.tail])) return;
    const Duration through = value_[edge.tail] + edge.weight;
    if (through >= value_[edge.head]) return;
    value_[edge.head] = through;
    push(heap, through - potential_[edge.head], edge.head);
  };
  for (TimePoint p = 0; p < known_.size(); ++p)
    if (known_[p] == 0) value_[p] = no_bound;
  for (const Edge& edge : edges_)
    if (known_[edge.tail] != 0) relax(edge);
  while (!heap.empty()) {
    const auto [key, point] = pop(heap);
    if (key != value_[point] - potential_[point]) continue;
    for (std::uint32_t i = out_begin_[point]; i < out_begin_[point + 1]; ++i) relax(edges_[out_[i]]);
  }
  std::fill(known_.begin(), known_.end(), 1);
  std::fill(passed_.begin(), passed_.end(), 0);
  std::fill(sure_above_.begin(), sure_above_.end(), -no_bound);
  unsure_.clear();
}

/// Shortest distances are a potential of their own; where there are none the old one stands, raised.
void LazyShortestPaths::rebase() const {
  Duration raise{0};
  for (const Edge& edge : edges_)
    if (bounded(edge.weight) && !bounded(value_[edge.tail]) && bounded(value_[edge.head]))
      raise = std::max(raise, value_[edge.head] - edge.weight - potential_[edge.tail]);
  for (TimePoint p = 0; p < value_.size(); ++p)
    potential_[p] = bounded(value_[p]) ? value_[p] : potential_[p] + raise;
  floor_ = Duration{0};
  ++rebases_;
}

}  // namespace roci::temporal
