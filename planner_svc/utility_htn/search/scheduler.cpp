#include "planner_svc/utility_htn/search/scheduler.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace roci::planner::utility_htn::search {

using temporal::bounded, temporal::Duration, temporal::no_bound, temporal::plus, temporal::Time;
using temporal::timelines::Interval, temporal::timelines::Timelines;

namespace {

// Places links one after the other; what is placed is taken back when it goes.
class Placement {
 public:
  Placement(std::span<const Link> links, Timelines& timelines)
      : links_(links), timelines_(timelines), begin_(timelines.mark()) {}
  Placement(const Placement&) = delete;
  Placement& operator=(const Placement&) = delete;
  ~Placement() {
    if (!kept_) timelines_.undo(begin_);
  }

  std::size_t size() const { return starts_.size(); }
  bool whole() const { return size() == links_.size(); }
  const Link& next() const { return links_[size()]; }
  Time start(std::size_t link) const { return starts_[link]; }

  // When the next link may start because of the one before it.
  Interval by_gap() const {
    if (starts_.empty()) return {-no_bound, no_bound};
    const Time end = plus(starts_.back(), links_[size() - 1].footprint.duration);
    return {plus(end, next().shortest_gap), plus(end, next().longest_gap)};
  }
  Interval window() const {
    const Interval gap = by_gap();
    return {std::max(gap.earliest, next().starts.earliest), std::min(gap.latest, next().starts.latest)};
  }

  void push(Time start) {
    marks_.push_back(timelines_.mark());
    timelines_.place(next().id, next().footprint, start);
    starts_.push_back(start);
  }
  void pop() {
    timelines_.undo(marks_.back());
    marks_.pop_back();
    starts_.pop_back();
  }
  std::vector<Time> keep() {
    kept_ = true;
    return std::move(starts_);
  }

 private:
  std::span<const Link> links_;
  Timelines& timelines_;
  std::size_t begin_;
  bool kept_ = false;
  std::vector<std::size_t> marks_;
  std::vector<Time> starts_;
};

// Where the link may start in the valid interval after the one that holds `start`, if there is one.
std::optional<Time> next_interval(const Link& link, const Timelines& timelines, Interval window, Time start) {
  if (start >= window.latest) return std::nullopt;
  for (const Interval& valid : timelines.valid_starts(link.footprint, {start, window.latest})) {
    if (valid.earliest > start) return valid.earliest;
  }
  return std::nullopt;
}

// Places all links as early as they go. `floors` are the earliest starts known to make sense; they only rise.
class EarliestPlacement {
 public:
  EarliestPlacement(std::span<const Link> links, Timelines& timelines, std::size_t attempts)
      : links_(links), timelines_(timelines), placement_(links, timelines), attempts_(attempts) {
    for (const Link& link : links) floors_.push_back(link.starts.earliest);
  }

  std::optional<std::vector<Time>> run() {
    while (!placement_.whole()) {
      if (!place_next()) return std::nullopt;
    }
    return placement_.keep();
  }

 private:
  bool place_next() {
    const Link& link = placement_.next();
    const Interval gap = placement_.by_gap();
    const Interval window{std::max(gap.earliest, floors_[placement_.size()]), link.starts.latest};
    if (window.earliest > window.latest) return false;  // later starts of those before only make it worse
    const std::optional<Time> found = timelines_.first_valid_start(link.footprint, window);
    if (!found) return go_back();
    if (*found <= gap.latest) {
      placement_.push(*found);
      return true;
    }
    const Link& before = links_[placement_.size() - 1];
    return put_off(plus(plus(*found, -link.longest_gap), -before.footprint.duration));
  }

  // Takes the last link back and starts it no sooner than that.
  bool put_off(Time start) {
    if (attempts_ == 0) return false;
    --attempts_;
    placement_.pop();
    Time& floor = floors_[placement_.size()];
    floor = std::max(floor, start);
    return true;
  }

  // The next link has no place at all: perhaps it has one when an earlier link runs in a later valid interval.
  bool go_back() {
    while (placement_.size() > 0 && backtracks_ > 0) {
      const std::size_t last = placement_.size() - 1;
      const Time start = placement_.start(last);
      placement_.pop();
      const std::optional<Time> later =
          next_interval(links_[last], timelines_, {start, placement_.window().latest}, start);
      if (!later) continue;
      --backtracks_;
      floors_[last] = *later;
      for (std::size_t after = last + 1; after < links_.size(); ++after)
        floors_[after] = links_[after].starts.earliest;
      return true;
    }
    return false;
  }

  std::span<const Link> links_;
  Timelines& timelines_;
  Placement placement_;
  std::size_t attempts_;
  std::size_t backtracks_ = kMostBacktracks;
  std::vector<Time> floors_;
};

Duration distance(Time a, Time b) { return a < b ? b - a : a - b; }

// The points of the valid intervals at which to try, the best first.
std::vector<Time> candidates(const Link& link, const Timelines& timelines, Interval window) {
  std::vector<Time> out;
  if (window.earliest > window.latest) return out;
  const std::vector<Interval> valid = timelines.valid_starts(link.footprint, window);
  const Duration preferred = link.preferred_start;
  for (const Interval& interval : valid)
    out.push_back(bounded(preferred) ? std::clamp(preferred, interval.earliest, interval.latest)
                                     : interval.earliest);
  if (bounded(preferred))
    std::ranges::stable_sort(out, {}, [preferred](Time start) { return distance(start, preferred); });
  return out;
}

bool place_nearest(Placement& placement, const Timelines& timelines, std::size_t& attempts) {
  if (placement.whole()) return true;
  for (const Time start : candidates(placement.next(), timelines, placement.window())) {
    if (attempts == 0) return false;
    --attempts;
    placement.push(start);
    if (place_nearest(placement, timelines, attempts)) return true;
    placement.pop();
  }
  return false;
}

}  // namespace

std::optional<std::vector<Time>> EarliestScheduler::schedule(std::span<const Link> links,
                                                             Timelines& timelines) const {
  return EarliestPlacement(links, timelines, attempts_).run();
}

std::optional<std::vector<Time>> NearestScheduler::schedule(std::span<const Link> links,
                                                            Timelines& timelines) const {
  const auto prefers = [](const Link& link) { return bounded(link.preferred_start); };
  if (std::ranges::any_of(links, prefers)) {
    Placement placement(links, timelines);
    std::size_t attempts = attempts_;
    if (place_nearest(placement, timelines, attempts)) return placement.keep();
  }
  return EarliestScheduler(attempts_).schedule(links, timelines);
}

std::vector<std::string> scheduler_names() { return {"earliest", "nearest"}; }

std::unique_ptr<Scheduler> make_scheduler(std::string_view name) {
  if (name == "earliest") return std::make_unique<EarliestScheduler>();
  if (name == "nearest") return std::make_unique<NearestScheduler>();
  std::string known;
  for (const std::string& each : scheduler_names()) known += (known.empty() ? "" : ", ") + each;
  throw std::invalid_argument("there is no scheduler '" + std::string(name) + "'; there are: " + known);
}

}  // namespace roci::planner::utility_htn::search
