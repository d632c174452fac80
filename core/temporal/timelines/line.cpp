#include "core/temporal/timelines/line.hpp"

#include <algorithm>
#include <optional>
#include <utility>

namespace roci::temporal::timelines {

Line::Line(Bounds range, Exact initial, Micros past, Micros end, std::size_t block)
    : range_(range),
      past_(past),
      end_(end),
      block_(block),
      blocks_{Block(past, block)},
      courses_{Course{initial, 0, {}}} {}

std::size_t Line::block_of(Micros time) const {
  const auto next = std::ranges::upper_bound(blocks_, time, {}, &Block::first);
  return next == blocks_.begin() ? 0 : static_cast<std::size_t>(next - blocks_.begin()) - 1;
}

const Course& Line::course(std::size_t i) const {
  for (; known_ <= i; ++known_)
    courses_[known_] = blocks_[known_ - 1].run(courses_[known_ - 1], blocks_[known_].first());
  return courses_[i];
}

void Line::changed(std::size_t i) {
  known_ = std::min(known_, i + 1);
  forget_knots();
}

void Line::split(std::size_t i) {
  std::optional<Block> later = blocks_[i].split();
  if (!later) return;
  blocks_.insert(blocks_.begin() + static_cast<std::ptrdiff_t>(i) + 1, std::move(*later));
  courses_.insert(courses_.begin() + static_cast<std::ptrdiff_t>(i) + 1, Course{});
}

void Line::add(const Event& event) {
  const std::size_t i = block_of(event.time);
  blocks_[i].add(event);
  ++events_;
  changed(i);
  split(i);
}

void Line::erase(const Event& event) {
  const std::size_t i = block_of(event.time);
  if (!blocks_[i].erase(event)) return;
  --events_;
  changed(i);
}

void Line::add(const Ask& ask) {
  const std::size_t first = block_of(ask.from.time);
  for (std::size_t i = first; i < blocks_.size() && (i == first || blocks_[i].first() <= ask.to.time); ++i)
    blocks_[i].add(ask);
  ++asks_;
  changed(first);
  split(first);
}

void Line::erase(const Ask& ask) {
  const std::size_t first = block_of(ask.from.time);
  for (std::size_t i = first; i < blocks_.size() && (i == first || blocks_[i].first() <= ask.to.time); ++i)
    blocks_[i].erase(ask);
  --asks_;
  forget_knots();
}

void Line::amend(Exact value, Exact rate) {
  courses_.front().value += value;
  courses_.front().rate += rate;
  changed(0);
}

void Line::observe(Micros time, Exact value) {
  const Event event{time, Turn::observed, ImpactKind::assign, 0, 0, value};
  erase(event);
  add(event);
}

void Line::fold(Micros now) {
  const std::size_t i = block_of(now);
  Course course = blocks_[i].at(this->course(i), {now, Side::before});
  course.reset = {};
  std::vector<Block> before{Block(now, block_)};
  before.swap(blocks_);
  courses_.assign(1, course);
  known_ = 1;
  forget_knots();
  events_ = asks_ = 0;
  past_ = now;
  const Position edge{now, Side::before};
  for (const Block& block : before) {
    for (const Event& event : block.events())
      if (event.time >= now) add(event);
    for (Ask ask : block.asks()) {
      if (ask.from.time < block.first() || ask.to < edge) continue;  // it began in another block, or is over
      ask.from = std::max(ask.from, edge);
      add(ask);
    }
  }
}

Exact Line::value(Position at) const {
  if (at.time < past_) return courses_.front().value;
  const std::size_t i = block_of(at.time);
  return blocks_[i].at(course(i), at).value;
}

const Summary& Line::summary(std::size_t i) const {
  const Block& block = blocks_[i];
  if (!block.summarized(range_, course(i), closing(i)))
    block.summarize(range_, course(i), closing(i), knots(i));
  return block.summary();
}

std::span<const Knot> Line::knots(std::size_t i) const {
  if (knots_of_ != i) {
    knots_.clear();
    blocks_[i].knots(course(i), closing(i), knots_);
    knots_of_ = i;
  }
  return knots_;
}

void Line::knots(std::size_t first, std::size_t last, std::vector<Knot>& knots) const {
  knots.clear();
  for (std::size_t i = first; i <= last; ++i) {
    if (i > first) knots.pop_back();
    blocks_[i].knots(course(i), closing(i), knots);
  }
}

}  // namespace roci::temporal::timelines
