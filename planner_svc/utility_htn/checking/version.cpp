#include "planner_svc/utility_htn/checking/version.hpp"

#include <algorithm>
#include <charconv>
#include <iterator>
#include <optional>
#include <set>
#include <string_view>
#include <unordered_map>

namespace roci::planner::utility_htn::checking {

using temporal::FlexiblePlan, temporal::PlanActivity, temporal::Time, temporal::Token;

namespace {

/// "task#BLOCK.LINK", taken apart.
struct Name {
  std::string task;
  std::uint32_t block = 0;
  std::uint32_t link = 0;
};

std::uint64_t step_id(const Name& name) { return (std::uint64_t{name.block} << 32U) | name.link; }

std::optional<Name> name_of(const std::string& id) {
  const std::size_t mark = id.rfind('#');
  const std::size_t dot = id.rfind('.');
  if (mark == std::string::npos || dot == std::string::npos || dot < mark) return std::nullopt;
  Name out{id.substr(0, mark), 0, 0};
  const bool block = std::from_chars(id.data() + mark + 1, id.data() + dot, out.block).ptr == id.data() + dot;
  const char* const end = id.data() + id.size();
  return block && std::from_chars(id.data() + dot + 1, end, out.link).ptr == end ? std::optional(out)
                                                                                 : std::nullopt;
}

template <class Items, class Member>
std::optional<std::uint32_t> index_of(const Items& items, std::string_view name, Member member) {
  const auto found = std::ranges::find(items, name, member);
  if (found == items.end()) return std::nullopt;
  return static_cast<std::uint32_t>(found - items.begin());
}

class Reader {
 public:
  Reader(const model::Network& network, const FlexiblePlan& plan, const temporal::Progress* progress,
         Time now)
      : network_(network), plan_(plan), progress_(progress), now_(now) {
    for (const temporal::TemporalConstraint& one : plan.constraints)
      if (one.kind == temporal::ConstraintKind::window && one.from_point == temporal::origin_point)
        starts_[one.to_point] = plan.origin + one.lower;
    out_.values = model::priors(network);
  }

  Version run() {
    for (const Token& token : plan_.tokens)
      token.start_point == temporal::origin_point ? read_past(token) : read_request(token);
    for (const PlanActivity& activity : plan_.activities) read_step(activity);
    for (auto& [number, block] : blocks_) keep(number, block);
    return std::move(out_);
  }

 private:
  void read_request(const Token& token) {
    const auto* held = std::get_if<temporal::State>(&token.held);
    const auto task = index_of(network_.tasks, token.timeline, &model::Task::id);
    std::uint32_t number = 0;
    const bool numbered =
        held != nullptr && held->arguments.size() == 1 &&
        std::from_chars(held->arguments.front().data(),
                        held->arguments.front().data() + held->arguments.front().size(), number)
                .ec == std::errc{};
    if (!task || !numbered) {
      out_.faults.push_back("the token of " + token.timeline + " names no block of a request");
    } else {
      blocks_[number].request = *task;
      ends_[number] = token.end_point;
    }
  }

  void read_past(const Token& token) {
    const std::string_view name = token.timeline;
    const std::string_view rest = name.substr(std::min(name.size(), name.find('.') + 1));
    const auto* number = std::get_if<double>(&token.held);
    if (name.starts_with("done.") || name.starts_with("withdrawn.")) {
      if (const auto task = index_of(network_.tasks, rest, &model::Task::id)) out_.closed.push_back(*task);
    } else if (name.starts_with("parameter.") && number != nullptr) {
      if (const auto parameter = index_of(network_.parameters, rest, &model::Parameter::name))
        out_.values[*parameter] = *number;
    } else if (name.starts_with("internal.")) {
      const auto timeline = index_of(network_.timelines, rest, &temporal::timelines::Definition::name);
      if (!timeline) return;
      const auto state =
          index_of(network_.timelines[*timeline].states, temporal::to_text(token.held), std::identity{});
      out_.internal.push_back({*timeline, now_, number != nullptr ? *number : state ? *state : 0.0});
    }
  }

  void read_step(const PlanActivity& activity) {
    const auto name = name_of(activity.id);
    if (!name) return;  // it gives timelines their first values
    const auto task = index_of(network_.tasks, name->task, &model::Task::id);
    const auto block = blocks_.find(name->block);
    if (!task || block == blocks_.end()) {
      out_.faults.push_back(activity.id + " is no task of a block");
      return;
    }
    Step step{step_id(*name), *task, starts_[activity.start_point], activity.duration_lower,
              activity.commit == temporal::CommitState::committed};
    const auto went =
        progress_ == nullptr ? temporal::Progress::const_iterator{} : progress_->find(activity.id);
    const bool known = progress_ != nullptr && went != progress_->end();
    if (known && went->second.started) {
      step.start = *went->second.started;
      const Time end = went->second.ended.value_or(std::max(now_, step.start + *step.duration));
      step.due = !went->second.ended && end == now_;
      step.overdue = step.due && step.start + *step.duration < now_;
      step.duration = end - step.start;
      const auto state = went->second.state;
      expect(*task, went->second);
      if (!temporal::is_over(state) || state == temporal::ActivityState::succeeded)
        effective_.insert(step.id);
      else
        failed_.insert(step.id);
    } else if (known && temporal::is_over(went->second.state)) {
      failed_.insert(step.id);
    } else if (step.committed) {
      step.due = step.start <= now_;
      step.overdue = step.start < now_;
      step.start = std::max(step.start, now_);
    }
    if (activity.end_point == ends_[name->block]) whole_.insert(name->block);
    if (!known || !temporal::is_over(went->second.state)) ++running_[name->block];
    block->second.steps.push_back(step);
  }

  void expect(model::TaskIndex index, const temporal::ActivityProgress& went) {
    const model::Task& task = network_.tasks[index];
    const bool begins_by_itself = task.commands.empty() && !went.ended;
    const bool has_just_done = !task.commands.empty() && went.state == temporal::ActivityState::succeeded &&
                               now_ < *went.ended + network_.cycle.process_interval;
    for (const model::Impact& impact : task.impacts) {
      if (!model::sets_reported_state(network_, impact)) continue;
      const bool at_end = impact.moment == temporal::ImpactWhen::at_end;
      if (at_end ? has_just_done : begins_by_itself)
        out_.expected.push_back({impact.timeline, at_end ? *went.ended : *went.started,
                                 model::evaluate(impact.amount, out_.values)});
    }
  }

  // A block that is not whole, or of which a step has failed, is no plan any more. What has begun of it counts; what is
  // committed does up to the link that has failed, and is skipped behind it.
  void keep(std::uint32_t number, Block& block) {
    std::ranges::sort(block.steps, {}, &Step::id);
    bool whole = whole_.contains(number) && std::ranges::none_of(block.steps, [&](const Step& step) {
                   return failed_.contains(step.id);
                 });
    for (std::size_t link = 0; link < block.steps.size(); ++link)
      whole = whole && block.steps[link].id == ((std::uint64_t{number} << 32U) | link);
    if (!whole) {
      out_.broken.insert(number);
      out_.broken_off.push_back(block.request);
      bool follows = true;
      for (std::size_t link = 0; link < block.steps.size(); ++link) {
        const Step& step = block.steps[link];
        follows = follows && step.id == ((std::uint64_t{number} << 32U) | link) && step.committed &&
                  !failed_.contains(step.id);
        if (follows || effective_.contains(step.id)) out_.rests.push_back(step);
      }
      return;
    }
    if (running_[number] == 0) out_.over.insert(number);
    out_.blocks.push_back(block);
  }

  const model::Network& network_;
  const FlexiblePlan& plan_;
  const temporal::Progress* progress_;
  Time now_;
  std::unordered_map<temporal::TimePoint, Time> starts_;
  std::map<std::uint32_t, Block> blocks_;
  std::map<std::uint32_t, temporal::TimePoint> ends_;  // of the last link
  std::map<std::uint32_t, std::size_t> running_;       // steps that are not over
  std::set<std::uint64_t> effective_;                  // steps that have begun and have not failed
  std::set<std::uint64_t> failed_;                     // steps that are over without success
  std::set<std::uint32_t> whole_;                      // blocks that have it
  Version out_;
};

}  // namespace

std::optional<std::uint64_t> step_named(const std::string& activity) {
  const auto name = name_of(activity);
  return name ? std::optional(step_id(*name)) : std::nullopt;
}

std::uint32_t number_of(const Block& block) {
  return static_cast<std::uint32_t>(block.steps.front().id >> 32U);
}

Version version_of(const model::Network& network, const FlexiblePlan& plan,
                   const temporal::Progress* progress, Time now) {
  return Reader(network, plan, progress, now).run();
}

std::vector<Step> downlinks_over(const model::Network& network, const FlexiblePlan& plan,
                                 const temporal::Progress& progress) {
  std::vector<Step> out;
  for (const PlanActivity& activity : plan.activities) {
    const auto name = name_of(activity.id);
    const auto went = progress.find(activity.id);
    if (!name || went == progress.end() || !went->second.started || !went->second.ended) continue;
    const auto task = index_of(network.tasks, name->task, &model::Task::id);
    if (!task || !network.tasks[*task].downlinks) continue;
    out.push_back(
        {step_id(*name), *task, *went->second.started, *went->second.ended - *went->second.started, true});
  }
  return out;
}

}  // namespace roci::planner::utility_htn::checking
