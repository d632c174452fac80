#include "core/temporal/timelines/timelines.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

#include "core/temporal/timelines/check.hpp"
#include "core/temporal/timelines/placement.hpp"

namespace roci::temporal::timelines {
namespace {

Bounds range_of(const Definition& definition) {
  if (definition.kind == Kind::atomic) return {0, kUnit, 0};
  if (definition.kind != Kind::state)
    return {exact_amount(definition.lowest), exact_amount(definition.highest), 0};
  const std::size_t count = definition.states.size();
  return {-kBeyond, kBeyond, count == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << count) - 1};
}

Exact amount_of(const Impact& impact) {
  return impact.kind == ImpactKind::rate ? exact_rate(impact.amount) : exact_amount(impact.amount);
}

}  // namespace

Timelines::Timelines(std::vector<Definition> definitions, Time origin)
    : Timelines(std::move(definitions), Extent{.origin = origin}) {}

Timelines::Timelines(std::vector<Definition> definitions, const Extent& extent)
    : definitions_(std::move(definitions)),
      past_(extent.origin.count()),
      end_(extent.end.count()),
      most_impacts_(extent.most_impacts) {
  if (extent.origin < -kLastTime || extent.end > kLastTime || extent.origin >= extent.end)
    throw std::invalid_argument("timelines end after their origin, both within 317 years of the epoch");
  for (const Definition& definition : definitions_) {
    refuse_faults(definition);
    lines_.emplace_back(range_of(definition), exact_amount(definition.initial), past_, end_, extent.block);
  }
}

Kept Timelines::kept() const {
  Kept kept{.tasks = tasks_.size(), .undoable = log_.size()};
  for (const Line& line : lines_) {
    kept.events += line.events();
    kept.asks += line.asks();
  }
  return kept;
}

/// Calls `change` with the timeline and each event that the task still has to come.
template <class Do>
void Timelines::each_event(TaskId id, const Task& task, Do change) const {
  const bool point = !task.started && task.start == task.end;
  const std::vector<Impact>& impacts = task.footprint.impacts;
  for (std::size_t i = 0; i < impacts.size(); ++i) {
    const Impact& impact = impacts[i];
    const Exact amount = amount_of(impact);
    const bool during = impact.moment == ImpactWhen::during;
    const auto order = static_cast<std::uint32_t>(i);
    if (point && during) continue;
    if (impact.moment != ImpactWhen::at_end && !task.started)
      change(impact.timeline, Event{task.start, Turn::starts, impact.kind, id, order, amount});
    if (impact.moment == ImpactWhen::at_start) continue;
    // Without a duration, the end acts among the starts, behind the task's own.
    const Turn turn = point ? Turn::starts : Turn::ends;
    const auto last = static_cast<std::uint32_t>(point ? i + impacts.size() : i);
    change(impact.timeline, Event{task.end, turn, impact.kind, id, last, during ? -amount : amount});
  }
}

/// Calls `change` with the timeline and each ask that the task still has to come.
template <class Do>
void Timelines::each_ask(TaskId id, const Task& task, Do change) const {
  const bool point = !task.started && task.start == task.end;
  const std::vector<Constraint>& constraints = task.footprint.constraints;
  for (std::size_t i = 0; i < constraints.size(); ++i) {
    Ask ask{id, static_cast<std::uint32_t>(i), {}, {}, bounds_of(constraints[i])};
    switch (constraints[i].phase) {
      case Phase::pre:
        if (task.started) continue;
        ask.from = ask.to = {task.start, Side::between};
        break;
      case Phase::maintenance:
        if (point) continue;
        ask.from = {task.start, task.started ? Side::before : Side::after};
        ask.to = {task.end, Side::before};
        break;
      case Phase::post:
        ask.from = ask.to = {task.end, point ? Side::after : Side::between};
        break;
    }
    change(constraints[i].timeline, ask);
  }
}

void Timelines::put(TaskId id, const Task& task) {
  each_event(id, task, [&](Index timeline, const Event& event) { lines_[timeline].add(event); });
  each_ask(id, task, [&](Index timeline, const Ask& ask) { lines_[timeline].add(ask); });
}

void Timelines::take(TaskId id, const Task& task) {
  each_event(id, task, [&](Index timeline, const Event& event) { lines_[timeline].erase(event); });
  each_ask(id, task, [&](Index timeline, const Ask& ask) { lines_[timeline].erase(ask); });
}

/// Gives back at the edge of the past what a task that is removed has taken `during` itself.
void Timelines::amend_for_removed(const Task& task, int sign) {
  if (!task.started) return;
  for (const Impact& impact : task.footprint.impacts) {
    if (impact.moment != ImpactWhen::during) continue;
    const Exact amount = sign * amount_of(impact);
    lines_[impact.timeline].amend(impact.kind == ImpactKind::delta ? -amount : 0,
                                  impact.kind == ImpactKind::rate ? -amount : 0);
  }
}

Timelines::Task& Timelines::find(TaskId id) {
  const auto found = tasks_.find(id);
  if (found == tasks_.end()) throw std::invalid_argument("task " + std::to_string(id) + " is not placed");
  return found->second;
}

void Timelines::place(TaskId id, const Footprint& footprint, Time start) {
  refuse_faults(definitions_, footprint);
  if (tasks_.contains(id)) throw std::invalid_argument("task " + std::to_string(id) + " is placed already");
  if (start < -kLastTime || start > kLastTime || (start + footprint.duration).count() > end_)
    throw std::invalid_argument("task " + std::to_string(id) + " ends after the end of the timelines");
  Task task{footprint, std::max(start.count(), past_), 0, false};
  if (task.size() > most_impacts_ - impacts_)
    throw std::length_error("timelines hold at most " + std::to_string(most_impacts_) +
                            " impacts and constraints");
  task.end = std::max((start + footprint.duration).count(), past_);
  put(id, task);
  impacts_ += task.size();
  tasks_.emplace(id, std::move(task));
  log_.push_back({Change::Kind::placed, id, {}});
}

void Timelines::move(TaskId id, Time start, Time end) {
  Task& task = find(id);
  if (end < start) throw std::invalid_argument("task " + std::to_string(id) + " cannot end before it starts");
  Change change{Change::Kind::moved, id, {{}, task.start, task.end, task.started}};
  take(id, task);
  if (!task.started) task.start = std::clamp(start.count(), past_, end_);
  task.end = std::clamp(end.count(), past_, end_);
  put(id, task);
  log_.push_back(std::move(change));
}

void Timelines::remove(TaskId id) {
  Task& task = find(id);
  take(id, task);
  amend_for_removed(task, 1);
  impacts_ -= task.size();
  log_.push_back({Change::Kind::removed, id, std::move(task)});
  tasks_.erase(id);
}

void Timelines::undo(std::size_t mark) {
  if (mark < forgotten_ || mark > forgotten_ + log_.size())
    throw std::logic_error("an observation or a consolidation lies between the mark and its undo");
  while (forgotten_ + log_.size() > mark) {
    Change& change = log_.back();
    if (change.kind == Change::Kind::removed) {
      put(change.id, change.before);
      amend_for_removed(change.before, -1);
      impacts_ += change.before.size();
      tasks_.emplace(change.id, std::move(change.before));
    } else {
      Task& task = find(change.id);
      take(change.id, task);
      if (change.kind == Change::Kind::moved) {
        task.start = change.before.start;
        task.end = change.before.end;
        put(change.id, task);
      } else {
        impacts_ -= task.size();
        tasks_.erase(change.id);
      }
    }
    log_.pop_back();
  }
}

void Timelines::forget_log() {
  forgotten_ += log_.size() + 1;
  log_.clear();
}

bool Timelines::observe(Index timeline, Time sampled, double value) {
  if (timeline >= lines_.size())
    throw std::invalid_argument("an observation is of a timeline that is not there");
  const Definition& definition = definitions_[timeline];
  const bool state = definition.kind == Kind::state;
  if (!std::isfinite(value) || std::abs(value) > kMostAmount ||
      (state &&
       (value != std::floor(value) || value < 0 || value >= static_cast<double>(definition.states.size()))))
    throw std::invalid_argument("an observed value of the timeline '" + definition.name + "' is no " +
                                (state ? "state of it" : "finite number of at most 1e15"));
  if (sampled.count() > end_)
    throw std::invalid_argument("an observation of the timeline '" + definition.name +
                                "' lies after the end of the timelines");
  forget_log();
  if (sampled.count() < past_) return false;
  lines_[timeline].observe(sampled.count(), exact_amount(value));
  return true;
}

void Timelines::consolidate(Time now) {
  forget_log();
  if (now.count() <= past_) return;
  past_ = std::min(now.count(), end_);
  for (Line& line : lines_) line.fold(past_);
  for (auto task = tasks_.begin(); task != tasks_.end();) {
    if (task->second.end < past_) {
      impacts_ -= task->second.size();
      task = tasks_.erase(task);
      continue;
    }
    if (task->second.start < past_) {
      task->second.started = true;
      task->second.start = past_;
    }
    ++task;
  }
}

double Timelines::value(Index timeline, Time at, Side side) const {
  return to_number(lines_.at(timeline).value({std::min(at.count(), end_), side}));
}

}  // namespace roci::temporal::timelines
