#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>
#include <unordered_map>

#include "planner_svc/utility_htn/adapter/plan_of.hpp"

namespace roci::planner::utility_htn::adapter {

using cycle::Block, cycle::Link, cycle::Stage, cycle::TaskId;
using temporal::FlexiblePlan, temporal::PlanActivity, temporal::Token;

namespace {

/// Reads one plan.
class Recovery {
 public:
  Recovery(const model::Network& network, const flattening::Chains& chains, const FlexiblePlan& plan)
      : network_(network), chains_(chains), plan_(plan) {
    for (const PlanActivity& activity : plan.activities) activities_.emplace(activity.id, &activity);
    for (const temporal::TemporalConstraint& one : plan.constraints)
      if (one.kind == temporal::ConstraintKind::window && one.from_point == temporal::origin_point)
        starts_[one.to_point] = one.lower;
    out_.past.values = model::priors(network);
    for (const auto& timeline : network.timelines) out_.past.internal.push_back(timeline.initial);
  }

  Recovered run() {
    for (const Token& token : plan_.tokens)
      token.start_point == temporal::origin_point ? take_past(token) : take_block(token);
    std::ranges::sort(out_.blocks, {}, &Block::number);
    return std::move(out_);
  }

 private:
  [[noreturn]] static void foreign(const std::string& what) {
    throw std::invalid_argument("the plan that is executed is not of this network: it has no " + what);
  }

  template <class Items, class Name>
  static std::size_t index(const Items& items, std::string_view name, Name Items::value_type::*member,
                           const char* what) {
    const auto found = std::ranges::find(items, name, member);
    if (found == items.end()) foreign(what + std::string(" ") + std::string(name));
    return static_cast<std::size_t>(found - items.begin());
  }

  std::set<model::TaskIndex>* tasks_of(std::string_view token) {
    if (token.starts_with("done.")) return &out_.past.done;
    if (token.starts_with("withdrawn.")) return &out_.past.withdrawn;
    return token.starts_with("contingent.") ? &out_.past.contingent : nullptr;
  }

  void take_past(const Token& token) {
    const std::string_view name = token.timeline;
    const std::string_view rest = name.substr(std::min(name.size(), name.find('.') + 1));
    if (auto* const tasks = tasks_of(name); tasks != nullptr) {
      tasks->insert(static_cast<model::TaskIndex>(index(network_.tasks, rest, &model::Task::id, "task")));
    } else if (name.starts_with("failed.")) {
      const auto* times = std::get_if<double>(&token.held);
      if (times == nullptr || !is_count(*times)) foreign("count in " + token.timeline);
      out_.past
          .failures[static_cast<model::TaskIndex>(index(network_.tasks, rest, &model::Task::id, "task"))] =
          static_cast<std::uint32_t>(*times);
    } else if (name.starts_with("parameter.")) {
      const auto* number = std::get_if<double>(&token.held);
      if (number == nullptr) foreign("number in " + token.timeline);
      out_.past.values[index(network_.parameters, rest, &model::Parameter::name, "parameter")] = *number;
    } else if (name.starts_with("internal.")) {
      const std::size_t timeline =
          index(network_.timelines, rest, &temporal::timelines::Definition::name, "timeline");
      const auto number = number_of(network_.timelines[timeline], token.held);
      if (!number) foreign("value " + temporal::to_text(token.held) + " of " + std::string(rest));
      out_.past.internal[timeline] = *number;
    } else if (name == kPastUntil) {
      const auto* seconds = std::get_if<double>(&token.held);
      if (seconds == nullptr) foreign("time in " + token.timeline);
      out_.past_until = temporal::seconds(*seconds);
    } else if (name == kLastBlock) {
      const auto* number = std::get_if<double>(&token.held);
      if (number == nullptr || !is_count(*number)) foreign("number in " + token.timeline);
      out_.last_block = std::max(out_.last_block, static_cast<std::uint32_t>(*number));
    } else if (name.starts_with("downlinks.")) {
      const auto* joules = std::get_if<double>(&token.held);
      std::uint32_t sol = 0;
      const auto read = std::from_chars(rest.data(), rest.data() + rest.size(), sol);
      if (read.ec != std::errc{} || joules == nullptr || !std::isfinite(*joules) || *joules < 0)
        foreign("joules of a sol in " + token.timeline);
      out_.spent_j[sol] = *joules;
    } else if (name.starts_with("measured.")) {
      out_.measured.emplace(rest);
    }
  }

  void take_block(const Token& token) {
    const auto* chain = std::get_if<temporal::State>(&token.held);
    Block block;
    if (chain == nullptr || chain->arguments.size() != 1) foreign("chain in the token of " + token.timeline);
    const std::string& number = chain->arguments.front();
    if (std::from_chars(number.data(), number.data() + number.size(), block.number).ec != std::errc{})
      foreign("number of a block in the token of " + token.timeline);
    block.chain =
        static_cast<std::uint32_t>(index(chains_.chains, chain->name, &flattening::Chain::name, "chain"));
    const auto& links = chains_.chains[block.chain].links;
    for (std::size_t i = 0; i < links.size(); ++i)
      block.links.push_back(link(block.number, i, links[i].task));
    out_.last_block = std::max(out_.last_block, block.number);
    out_.blocks.push_back(std::move(block));
  }

  // A link that the plan does not have has failed.
  Link link(std::uint32_t block, std::size_t i, model::TaskIndex task) {
    Link out{task, {}, {}, {}, Stage::failed};
    const TaskId id = cycle::task_id(block, i);
    const auto found = activities_.find(activity_id(network_, out, id));
    if (found == activities_.end()) return out;
    const PlanActivity& activity = *found->second;
    out.planned = out.start = plan_.origin + starts_[activity.start_point];
    out.end = out.start + activity.duration_lower;
    out.stage = activity.commit == temporal::CommitState::committed ? Stage::committed : Stage::planned;
    if (out.stage == Stage::committed) out.told = activity.duration_lower;
    out_.points.set(id, activity.start_point, activity.end_point);
    return out;
  }

  const model::Network& network_;
  const flattening::Chains& chains_;
  const FlexiblePlan& plan_;
  std::unordered_map<std::string, const PlanActivity*> activities_;
  std::unordered_map<temporal::TimePoint, temporal::Duration> starts_;
  Recovered out_;
};

}  // namespace

Recovered recover(const model::Network& network, const flattening::Chains& chains, const FlexiblePlan& plan) {
  return Recovery(network, chains, plan).run();
}

}  // namespace roci::planner::utility_htn::adapter
