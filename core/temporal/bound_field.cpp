#include "core/temporal/bound_field.hpp"

#include <algorithm>
#include <functional>
#include <utility>

namespace roci::temporal {
namespace {

/// Indices of the edges grouped by one of their ends: those of point p stand at [begin[p], begin[p + 1]).
template <typename EndOf>
void group(const std::vector<BoundField::Edge>& edges, std::size_t point_count, EndOf end_of,
           std::vector<std::uint32_t>& begin, std::vector<std::uint32_t>& grouped) {
  begin.assign(point_count + 1, 0);
  for (const auto& edge : edges) ++begin[end_of(edge) + 1];
  for (std::size_t p = 0; p < point_count; ++p) begin[p + 1] += begin[p];
  grouped.resize(edges.size());
  std::vector<std::uint32_t> next(begin.begin(), begin.end() - 1);
  for (std::uint32_t e = 0; e < edges.size(); ++e) grouped[next[end_of(edges[e])]++] = e;
}

}  // namespace

BoundField::BoundField(std::vector<Edge> edges, std::vector<Duration> potential)
    : edges_(std::move(edges)),
      potential_(std::move(potential)),
      value_(potential_.size(), no_bound),
      parent_(potential_.size(), none),
      fixed_(potential_.size(), 0),
      saved_mark_(potential_.size(), 0),
      affected_mark_(potential_.size(), 0) {
  group(
      edges_, potential_.size(), [](const Edge& e) { return e.tail; }, out_begin_, out_);
  group(
      edges_, potential_.size(), [](const Edge& e) { return e.head; }, in_begin_, in_);
}

void BoundField::fix(TimePoint point, Duration value) {
  begin();
  const Duration before = value_[point];
  fixed_[point] = 1;
  if (value > before) collect_below(point);
  set(point, value, none);
  recompute_affected();
  for (std::uint32_t i = out_begin_[point]; i < out_begin_[point + 1]; ++i) relax(out_[i]);
  settle();
  finish();
}

void BoundField::undo_fix(TimePoint point) {
  fixed_[point] = 0;
  for (const Saved& saved : saved_) {
    value_[saved.point] = saved.value;
    parent_[saved.point] = saved.parent;
  }
  saved_.clear();
  changes_.clear();
}

void BoundField::reweigh(std::uint32_t edge, Duration weight) {
  begin();
  const bool rises = weight > edges_[edge].weight;
  edges_[edge].weight = weight;
  const TimePoint head = edges_[edge].head;
  if (rises && parent_[head] == static_cast<std::int32_t>(edge)) {
    affected_mark_[head] = 1;
    affected_.push_back(head);
    collect_below(head);
    recompute_affected();
  } else if (!rises) {
    relax(edge);
  }
  settle();
  finish();
}

void BoundField::cut_off(TimePoint point) {
  begin();
  affected_mark_[point] = 1;
  affected_.push_back(point);
  collect_below(point);
  for (std::uint32_t i = out_begin_[point]; i < out_begin_[point + 1]; ++i) edges_[out_[i]].weight = no_bound;
  for (std::uint32_t i = in_begin_[point]; i < in_begin_[point + 1]; ++i) edges_[in_[i]].weight = no_bound;
  recompute_affected();
  settle();
  finish();
}

void BoundField::begin() {
  saved_.clear();
  changes_.clear();
}

void BoundField::save(TimePoint point) {
  if (saved_mark_[point] != 0) return;
  saved_mark_[point] = 1;
  saved_.push_back({point, value_[point], parent_[point]});
}

void BoundField::set(TimePoint point, Duration value, std::int32_t parent) {
  save(point);
  value_[point] = value;
  parent_[point] = parent;
}

/// Marks the points whose value comes through root.
void BoundField::collect_below(TimePoint root) {
  std::vector<TimePoint> open{root};
  while (!open.empty()) {
    const TimePoint point = open.back();
    open.pop_back();
    for (std::uint32_t i = out_begin_[point]; i < out_begin_[point + 1]; ++i) {
      const TimePoint head = edges_[out_[i]].head;
      if (parent_[head] != static_cast<std::int32_t>(out_[i]) || affected_mark_[head] != 0) continue;
      affected_mark_[head] = 1;
      affected_.push_back(head);
      open.push_back(head);
    }
  }
}

void BoundField::recompute_affected() {
  for (const TimePoint point : affected_) set(point, no_bound, none);
  for (const TimePoint point : affected_)
    for (std::uint32_t i = in_begin_[point]; i < in_begin_[point + 1]; ++i)
      if (affected_mark_[edges_[in_[i]].tail] == 0) relax(in_[i]);
  for (const TimePoint point : affected_) affected_mark_[point] = 0;
  affected_.clear();
}

void BoundField::relax(std::uint32_t index) {
  const Edge& edge = edges_[index];
  if (fixed_[edge.head] != 0 || !bounded(edge.weight) || !bounded(value_[edge.tail])) return;
  const Duration value = value_[edge.tail] + edge.weight;
  if (value >= value_[edge.head]) return;
  set(edge.head, value, static_cast<std::int32_t>(index));
  heap_.emplace_back(value - potential_[edge.head], edge.head);
  std::push_heap(heap_.begin(), heap_.end(), std::greater<>{});
}

void BoundField::settle() {
  while (!heap_.empty()) {
    std::pop_heap(heap_.begin(), heap_.end(), std::greater<>{});
    const auto [key, point] = heap_.back();
    heap_.pop_back();
    if (key != value_[point] - potential_[point]) continue;
    for (std::uint32_t i = out_begin_[point]; i < out_begin_[point + 1]; ++i) relax(out_[i]);
  }
}

void BoundField::finish() {
  for (const Saved& saved : saved_) {
    saved_mark_[saved.point] = 0;
    if (saved.value != value_[saved.point]) changes_.push_back({saved.point, saved.value});
  }
}

}  // namespace roci::temporal
