#include "services/clock/clock_master.hpp"

#include <algorithm>
#include <utility>

#include "services/bounds/limits.hpp"
#include "services/clock/stream_topic.hpp"

namespace roci::services::clock {

ClockMaster::ClockMaster(std::string name, std::vector<std::string> roster, std::uint32_t micro_step_cap)
    : name_(std::move(name)), roster_(std::move(roster)), cap_(micro_step_cap) {}

bool ClockMaster::hears(const Member& member, const std::string& stream) {
  return find_subscription(member.subscriptions, stream) != member.subscriptions.end();
}

bool ClockMaster::ready(const v1::ClockReady& ready) {
  const auto member = members_.find(ready.service());
  if (member != members_.end()) {
    if (ready.incarnation() <= member->second.incarnation) return true;
    if (losses_.size() >= bounds::kRosterLosses) return false;
    lost(ready.service(), member->second.incarnation, "restarted");
  }
  const auto waiting = waiting_.find(ready.service());
  if (waiting != waiting_.end() && waiting->second.incarnation() > ready.incarnation()) return true;
  if (waiting == waiting_.end() && members_.size() + waiting_.size() >= bounds::kPeers) return false;
  waiting_[ready.service()] = ready;
  return true;
}

bool ClockMaster::done(const v1::ClockDone& done) {
  const auto found = members_.find(done.service());
  if (found == members_.end() || found->second.incarnation != done.incarnation()) return true;
  bool counted = true;
  Member& member = found->second;
  for (const v1::StreamCount& count : done.sent()) {
    StreamKey key{count.topic(), count.sender(), count.incarnation()};
    if (totals_.size() >= bounds::kCountedStreams && !totals_.contains(key)) {
      counted = false;
      continue;
    }
    std::uint64_t& total = totals_[std::move(key)];
    if (count.total() <= total) continue;
    total = count.total();
    for (auto& [service, other] : members_) {
      if (hears(other, count.topic())) other.input = true;
    }
  }
  const bool answers = temporal::Time(done.time_us()) == time_ && done.micro_step() == micro_step_;
  if (member.owes && !answers) return counted;
  if (member.owes) {
    member.owes = false;
    member.wish = done.wish_us() < 0 ? std::nullopt : std::optional(temporal::Time(done.wish_us()));
  } else {
    member.outside = true;  // sent again although nothing was asked: input from outside came in
  }
  return counted;
}

void ClockMaster::lost(const std::string& service, std::uint32_t incarnation, const std::string& cause) {
  const auto waiting = waiting_.find(service);
  if (waiting != waiting_.end() && waiting->second.incarnation() == incarnation) waiting_.erase(waiting);
  const auto found = members_.find(service);
  if (found == members_.end() || found->second.incarnation != incarnation) return;
  revise_ = true;  // whoever still owes may be waiting for samples that the dead one never gets across
  members_.erase(found);
  std::erase(participants_, service);
  v1::RosterLoss loss;
  loss.service(service);
  loss.incarnation(incarnation);
  loss.cause(cause);
  losses_.push_back(std::move(loss));
  roster_changed_ = true;
}

std::vector<std::string> ClockMaster::missing() const {
  std::vector<std::string> names;
  std::ranges::copy_if(roster_, std::back_inserter(names), [&](const std::string& service) {
    return !waiting_.contains(service) && !members_.contains(service);
  });
  return names;
}

std::vector<std::string> ClockMaster::awaited() const {
  std::vector<std::string> names;
  for (const auto& [service, member] : members_) {
    if (member.owes) names.push_back(service);
  }
  return names;
}

std::optional<ClockMaster::Window> ClockMaster::window() const {
  if (last_ || !awaited().empty() || (!started_ && !missing().empty())) return std::nullopt;
  if (!started_ || roster_changed_ || !waiting_.empty()) return Window{time_, time_};
  std::optional<temporal::Time> wish;
  bool outside = false;
  for (const auto& [service, member] : members_) {
    if (member.input) return Window{time_, time_};
    outside = outside || member.outside;
    if (member.wish) wish = wish ? std::min(*wish, *member.wish) : *member.wish;
  }
  if (wish && *wish <= time_) return Window{time_, time_};
  if (outside) return Window{time_, wish.value_or(temporal::no_bound)};
  if (wish) return Window{*wish, *wish};
  return std::nullopt;
}

void ClockMaster::admit() {
  for (const auto& [service, ready] : waiting_) {
    Member& member = members_[service];
    member.incarnation = ready.incarnation();
    member.subscriptions.insert(ready.subscriptions().begin(), ready.subscriptions().end());
    roster_changed_ = true;
  }
  waiting_.clear();
}

// Everyone acts in the step that announces a loss; after it nobody asks for the streams of the lost.
void ClockMaster::forget_dead_streams() {
  for (; forgotten_ < announced_; ++forgotten_) {
    const v1::RosterLoss& loss = losses_[forgotten_];
    std::erase_if(totals_, [&](const auto& stream) {
      return stream.first.sender == loss.service() && stream.first.incarnation == loss.incarnation();
    });
  }
  announced_ = losses_.size();
}

bool ClockMaster::wants_to_act(const Member& member, temporal::Time time) const {
  return roster_changed_ || member.input || member.outside || (member.wish && *member.wish <= time);
}

void ClockMaster::begin_step(temporal::Time time) {
  micro_step_ = started_ && time == time_ ? micro_step_ + 1 : 0;
  time_ = time;
  revision_ = 0;
  revise_ = false;
  started_ = true;
}

v1::ClockStep ClockMaster::issue(temporal::Time time) {
  begin_step(time);
  forget_dead_streams();
  admit();
  participants_.clear();
  for (auto& [service, member] : members_) {
    if (!wants_to_act(member, time)) continue;
    participants_.push_back(service);
    member.owes = true;
    member.input = false;
    member.outside = false;
    member.wish.reset();
  }
  roster_changed_ = false;
  if (micro_step_ > cap_) throw ClockError(livelock());
  return step();
}

std::optional<v1::ClockStep> ClockMaster::take_revision() {
  if (!std::exchange(revise_, false) || awaited().empty()) return std::nullopt;
  ++revision_;
  return step();
}

v1::ClockStep ClockMaster::issue_last() {
  begin_step(time_);
  last_ = true;
  participants_.clear();
  for (auto& [service, member] : members_) {
    participants_.push_back(service);
    member.owes = true;
  }
  return step();
}

v1::ClockStep ClockMaster::step() const {
  v1::ClockStep step;
  step.master(name_);
  step.time_us(time_.count());
  step.micro_step(micro_step_);
  step.revision(revision_);
  step.last(last_);
  step.losses(losses_);
  step.participants(participants_);
  for (const auto& [service, member] : members_) {
    v1::RosterEntry entry;
    entry.service(service);
    entry.incarnation(member.incarnation);
    step.roster().push_back(std::move(entry));
  }
  step.totals().reserve(totals_.size());
  for (const auto& [stream, total] : totals_) {
    v1::StreamCount count;
    count.topic(stream.topic);
    count.sender(stream.sender);
    count.incarnation(stream.incarnation);
    count.total(total);
    step.totals().push_back(std::move(count));
  }
  return step;
}

std::string ClockMaster::livelock() const {
  std::string text = "livelock: " + std::to_string(cap_) + " micro-steps at mission time " +
                     std::to_string(time_.count()) + " us, and these still act:";
  for (const std::string& service : participants_) text += " " + service;
  return text + "; look for services that answer each other without end, or timers that are set for now";
}

}  // namespace roci::services::clock
