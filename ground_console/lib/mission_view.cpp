#include "ground_console/lib/mission_view.hpp"

#include <algorithm>
#include <array>
#include <cstdio>
#include <tuple>

#include "core/temporal/activity_timeline.hpp"
#include "ground_console/lib/limits.hpp"

namespace roci::console::lib {
namespace {

// Senders number their samples; a restarted sender begins again with a higher incarnation.
bool newer(const v1::SampleHeader& a, const v1::SampleHeader& b) {
  return std::make_tuple(a.incarnation(), a.seq()) >= std::make_tuple(b.incarnation(), b.seq());
}

template <class Key, class T>
bool keep_newest(std::map<Key, T>& table, Key key, const T& value, std::size_t room = kEntries) {
  if (table.size() >= room && !table.contains(key)) return false;
  const auto [entry, added] = table.try_emplace(std::move(key), value);
  if (!added && (entry->second.header().sender() != value.header().sender() ||
                 newer(value.header(), entry->second.header()))) {
    entry->second = value;
  }
  return true;
}

template <class Table, class Key>
auto* found_or_null(const Table& table, const Key& key) {
  const auto entry = table.find(key);
  return entry == table.end() ? nullptr : &entry->second;
}

template <std::size_t N, class Enum>
const char* name_in(const std::array<const char*, N>& names, Enum value) {
  const auto index = static_cast<std::size_t>(value);
  return index < N ? names[index] : "unknown";
}

}  // namespace

void MissionView::note_time(const v1::SampleHeader& header) {
  now_us_ = std::max<std::int64_t>(now_us_, header.stamp_us());
}

void MissionView::take(const v1::MissionStatus& status) {
  note_time(status.header());
  if (missions_.size() >= kExecutives && !missions_.contains(status.executive())) return count(false);
  const auto [entry, added] = missions_.try_emplace(status.executive(), status);
  if (!added && newer(status.header(), entry->second.header())) entry->second = status;
}

void MissionView::count(bool kept) {
  if (!kept) ++unseen_;
}

void MissionView::take(const v1::Goal& goal) {
  count(keep_newest(goals_, GoalKey{goal.issuer(), goal.id()}, goal));
}

void MissionView::take(const v1::GoalStatus& status) {
  note_time(status.header());
  count(keep_newest(goal_statuses_, GoalKey{status.issuer(), status.id()}, status));
}

void MissionView::take(const v1::ExecutedPlan& executed) {
  note_time(executed.header());
  if (executed_.size() >= kExecutives && !executed_.contains(executed.executive())) return count(false);
  auto& versions = executed_[executed.executive()];
  versions.insert_or_assign(executed.version(), executed);
  if (versions.size() > kExecuted) versions.erase(versions.begin());
}

const std::map<std::uint32_t, v1::ExecutedPlan>& MissionView::executed() const {
  static const std::map<std::uint32_t, v1::ExecutedPlan> none;
  const auto found = executed_.find(executive());
  return found == executed_.end() ? none : found->second;
}

void MissionView::take(const v1::Plan& plan) {
  note_time(plan.header());
  if (plans_.size() >= kExecutives && !plans_.contains(plan.executive())) return count(false);
  const auto [entry, added] = plans_.try_emplace(plan.executive(), plan);
  if (!added && plan.version() >= entry->second.version()) entry->second = plan;
}

void MissionView::take(const v1::StepStatus& step) {
  note_time(step.header());
  count(keep_newest(steps_, {step.executive(), step.activity()}, step, kSteps));
}

void MissionView::take(const v1::Observation& observation) {
  note_time(observation.header());
  count(keep_newest(observations_, observation.timeline(), observation));
  extend_way(observation.timeline());
}

// Both coordinates of a place carry the same stamp; whichever comes second completes it.
void MissionView::extend_way(const std::string& timeline) {
  if (!timeline.ends_with(".x") && !timeline.ends_with(".y")) return;
  const std::string robot = timeline.substr(0, timeline.size() - 2);
  const auto* x = found_or_null(observations_, robot + ".x");
  const auto* y = found_or_null(observations_, robot + ".y");
  if (x == nullptr || y == nullptr || x->header().stamp_us() != y->header().stamp_us()) return;
  std::vector<Place>& way = ways_[robot];
  const Place place{x->observed().number(), y->observed().number()};
  if (!way.empty() && way.back() == place) return;
  way.push_back(place);
  if (way.size() <= kWay) return;
  std::size_t kept = 0;
  for (std::size_t i = 0; i < way.size(); i += 2) way[kept++] = way[i];
  way.resize(kept);
}

void MissionView::take(const v1::DataProduct& product) {
  note_time(product.header());
  count(keep_newest(products_, product.id(), product));
}

void MissionView::take(const v1::Event& event) {
  note_time(event.header());
  events_.push_back(event);
  ++events_seen_;
  if (events_.size() > kEvents) events_.pop_front();
}

void MissionView::take(const v1::Hazard& hazard) {
  note_time(hazard.header());
  count(keep_newest(hazards_, {hazard.found_by(), hazard.id()}, hazard));
}

void MissionView::take(const v1::FunctionOffer& offer) {
  note_time(offer.header());
  count(keep_newest(offers_, {offer.module_name(), offer.owner()}, offer, kServices));
}

void MissionView::take(const v1::DownlinkSchedule& schedule) {
  note_time(schedule.header());
  count(keep_newest(schedules_, schedule.robot(), schedule, kExecutives));
}

void MissionView::take(const v1::MissionOutlook& outlook) {
  note_time(outlook.header());
  count(keep_newest(outlooks_, outlook.robot(), outlook, kExecutives));
}

void MissionView::take(const v1::Command& command) {
  note_time(command.header());
  count(repairs_.take(command));
}

void MissionView::take(const v1::CommandAck& word) {
  note_time(word.header());
  count(repairs_.take(word));
}

void MissionView::take(const v1::KnownMap& map) {
  note_time(map.header());
  count(keep_newest(maps_, map.planner(), map, kServices));
}

std::uint64_t MissionView::model_version(const std::string& owner) const {
  std::uint64_t out = 0;
  for (const auto& [key, offer] : offers_)
    if (offer.owner() == owner) out = std::max<std::uint64_t>(out, offer.model_version());
  return out;
}

void MissionView::take(const v1::Heartbeat& heartbeat) {
  const auto age = [](const v1::Heartbeat& h) { return std::make_pair(h.incarnation(), h.progress()); };
  if (heartbeats_.size() >= kServices && !heartbeats_.contains(heartbeat.service())) return count(false);
  const auto [entry, added] = heartbeats_.try_emplace(heartbeat.service(), heartbeat);
  if (!added && age(heartbeat) >= age(entry->second)) entry->second = heartbeat;
}

void MissionView::take(const v1::Decision& decision) {
  note_time(decision.header());
  if (decisions_.size() >= kEntries && !decisions_.contains(decision.id())) return count(false);
  decisions_[decision.id()] = decision;
}

void MissionView::take(const v1::OrderStatus& status) {
  note_time(status.header());
  const GoalKey key{status.issuer(), status.id()};
  if (orders_.size() >= kEntries && !orders_.contains(key)) return count(false);
  std::vector<v1::OrderStatus>& stages = orders_[key];
  if (stages.size() >= kStages) stages.erase(stages.begin());
  stages.push_back(status);
}

const std::vector<v1::OrderStatus>& MissionView::order(const std::string& issuer,
                                                       const std::string& id) const {
  static const std::vector<v1::OrderStatus> kNone;
  const auto found = orders_.find({issuer, id});
  return found == orders_.end() ? kNone : found->second;
}

void MissionView::take(const v1::LeaseMessage& member) {
  if (members_.size() >= kServices && !members_.contains({member.executive(), member.member()}))
    return count(false);
  v1::LeaseMessage& known = members_[{member.executive(), member.member()}];
  if (member.epoch() >= known.epoch()) known = member;
}

const v1::LeaseMessage* MissionView::leader() const {
  const std::string seen = executive();
  const v1::LeaseMessage* leader = nullptr;
  for (const auto& [name, member] : members_) {
    if (name.first == seen && member.exec_role() == v1::EXEC_LEADING &&
        (leader == nullptr || member.epoch() > leader->epoch()))
      leader = &member;
  }
  return leader;
}

std::string MissionView::leaderless() const {
  std::string out;
  for (const auto& [name, member] : members_) {
    if (member.exec_role() == v1::EXEC_LEADING) return "";
    if (member.searching()) out += (out.empty() ? "" : ", ") + name.first + " (" + name.second + ")";
  }
  return out;
}

std::vector<std::string> MissionView::executives() const {
  std::vector<std::string> out;
  for (const auto& [name, mission] : missions_) out.push_back(name);
  for (const auto& [name, plan] : plans_)
    if (!missions_.contains(name)) out.push_back(name);
  std::ranges::sort(out);
  return out;
}

std::string MissionView::executive() const {
  if (!chosen_.empty()) return chosen_;
  const std::vector<std::string> known = executives();
  return known.empty() ? "" : known.front();
}

const v1::MissionStatus* MissionView::mission() const { return found_or_null(missions_, executive()); }

// The world tells of the end of a simulated run, also where goals are open and the executive has no outcome.
bool MissionView::ended() const {
  if (std::ranges::any_of(events_, [](const v1::Event& event) {
        return event.code() == "scenario.over" || event.code() == "scenario.time-up";
      }))
    return true;
  const auto has_outcome = [](const v1::MissionStatus& mission) { return !mission.outcome().empty(); };
  if (!chosen_.empty()) return mission() != nullptr && has_outcome(*mission());
  return !missions_.empty() &&
         std::ranges::all_of(missions_, [&](const auto& entry) { return has_outcome(entry.second); });
}

const v1::Plan* MissionView::plan() const { return found_or_null(plans_, executive()); }

const v1::Goal* MissionView::goal(const GoalKey& key) const { return found_or_null(goals_, key); }

const v1::StepStatus* MissionView::step(const std::string& activity) const {
  return found_or_null(steps_, std::pair(executive(), activity));
}

const v1::TimelineValue* MissionView::timeline(const std::string& name) const {
  const auto* observation = found_or_null(observations_, name);
  return observation == nullptr ? nullptr : &observation->observed();
}

const char* name_of(v1::MissionPhase phase) {
  return name_in(std::array{"idle", "pausing", "planning", "executing", "safe", "finished"}, phase);
}

const char* name_of(v1::ExecutedOutcome outcome) {
  return name_in(std::array{"finished", "broken", "cancelled", "replaced"}, outcome);
}

const char* name_of(v1::GoalState state) {
  return name_in(std::array{"rejected", "pending", "planned", "achieved", "dropped", "failed", "recalled"},
                 state);
}

const char* name_of(v1::GoalClass importance) {
  return name_in(std::array{"hard", "optional", "opportunistic"}, importance);
}

const char* name_of(v1::AckStage stage) { return name_in(std::array{"journaled", "held by both"}, stage); }

const char* name_of(v1::ActivityState state) {
  if (state > v1::ACTIVITY_CANCELLED) return "unknown";
  return temporal::to_string(static_cast<temporal::ActivityState>(state));
}

const char* name_of(v1::Severity severity) {
  return name_in(std::array{"debug", "info", "warning", "error"}, severity);
}

const char* name_of(v1::ServiceState state) {
  return name_in(std::array{"starting", "running", "degraded", "stopping"}, state);
}

const char* name_of(v1::ObstacleKind kind) { return name_in(std::array{"rock", "soil"}, kind); }

std::string value_text(double number) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.6g", number);
  return buffer.data();
}

std::string value_text(const v1::TimelineValue& value) {
  switch (value.kind()) {
    case v1::VALUE_NONE:
      return "none";
    case v1::VALUE_BOOLEAN:
      return value.truth() ? "true" : "false";
    case v1::VALUE_NUMBER:
      return value_text(value.number());
    case v1::VALUE_STATE:
      break;
  }
  std::string out = value.state();
  for (const std::string& argument : value.arguments()) out += " " + argument;
  return out;
}

std::string pair_text(const v1::LeaseMessage& leader) {
  const std::string other = leader.member() == "first" ? "second" : "first";
  const std::uint64_t known = std::min(leader.has().commits(), leader.receipt().commits());
  return leader.member() + " leads (epoch " + std::to_string(leader.epoch()) + "), " + other +
         (leader.entitled()
              ? " stands by, " + std::to_string(leader.has().commits() - known) + " commits behind"
              : " does not stand by");
}

std::string clock_text(std::int64_t time_us) {
  const std::int64_t s = time_us / 1'000'000;
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%02lld:%02lld:%02lld", static_cast<long long>(s / 3600),
                static_cast<long long>(s / 60 % 60), static_cast<long long>(s % 60));
  return buffer.data();
}

}  // namespace roci::console::lib
