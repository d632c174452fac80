#include "planner_svc/temporal_pddl/search/portfolio.hpp"

#include <algorithm>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "planner_svc/temporal_pddl/search/best_first_search.hpp"
#include "planner_svc/temporal_pddl/search/best_first_width_search.hpp"
#include "planner_svc/temporal_pddl/search/goal_alternatives.hpp"
#include "planner_svc/temporal_pddl/search/goal_serialization.hpp"

namespace roci::planner::temporal_pddl::search {

using call::Options;
using heuristics::FfHeuristic;
using task::Action;
using task::ActionCompression;
using task::Task;

namespace {

constexpr std::size_t kTurn = 250;    // evaluations
constexpr std::size_t kOpening = 50;  // before the first turn; easy tasks need no more

// The shares say how often turns come. What follows relaxed plans solves most tasks, and of these most with
// compressed actions; best-first width search solves what those do not solve.
constexpr std::size_t kFirstShare = 4;
constexpr std::size_t kLookaheadShare = 2;
constexpr std::size_t kWidthShare = 3;
constexpr std::size_t kAlternativesShare = 3;
constexpr std::size_t kStepByStepShare = 1;
constexpr std::size_t kSerializationShare = 1;

// Returns whether it makes a difference that actions are taken whole.
bool splits_actions(const Task& task) {
  return std::ranges::any_of(
      task.actions, [](const Action& action) { return !action.instantaneous() && !action.compression_safe; });
}

}  // namespace

ActionCompression strongest_compression(const Task& task, const Options& options) {
  return options.compress_all_actions && splits_actions(task) ? ActionCompression::always
                                                              : ActionCompression::where_safe;
}

namespace {

enum class MemberName {
  lookahead_compressed,
  lookahead,
  best_first_width,
  goal_alternatives,
  step_by_step_compressed,
  step_by_step,
  goal_serialization,
};

std::string_view phase_of(MemberName name) {
  switch (name) {
    case MemberName::lookahead_compressed:
      return "searching: lookahead, whole actions";
    case MemberName::lookahead:
      return "searching: lookahead";
    case MemberName::best_first_width:
      return "searching: best-first width";
    case MemberName::goal_alternatives:
      return "searching: one alternative of the goal";
    case MemberName::step_by_step_compressed:
      return "searching: step by step, whole actions";
    case MemberName::step_by_step:
      return "searching: step by step";
    case MemberName::goal_serialization:
      break;
  }
  return "searching: goal by goal";
}

// Is a search that takes turns with others; it is set up when its first turn comes.
struct Member {
  MemberName name;
  std::size_t share;
  std::unique_ptr<ResumableSearch> search = nullptr;
  std::size_t turns = 0;

  double served() const { return static_cast<double>(turns) / static_cast<double>(share); }
};

class Portfolio {
 public:
  Portfolio(const SearchContext& context, const Guide& guide, FfHeuristic& ff)
      : context_(context),
        guide_(guide),
        ff_(ff),
        strongest_(strongest_compression(context.task, context.options)) {
    const Options& options = context.options;
    const bool splits = strongest_ != ActionCompression::where_safe;
    const auto add_best_first = [&](bool lookahead, MemberName compressed, MemberName complete) {
      const std::size_t share = lookahead ? kLookaheadShare : kStepByStepShare;
      members_.push_back({compressed, members_.empty() ? kFirstShare : share});
      if (splits) members_.push_back({complete, share});
    };
    if (options.lookahead) add_best_first(true, MemberName::lookahead_compressed, MemberName::lookahead);
    if (options.best_first_width && options.dominance)
      members_.push_back({MemberName::best_first_width, kWidthShare});
    if (options.lookahead && GoalAlternatives::has_some(context.task))
      members_.push_back({MemberName::goal_alternatives, kAlternativesShare});
    add_best_first(false, MemberName::step_by_step_compressed, MemberName::step_by_step);
    if (options.goal_serialization) members_.push_back({MemberName::goal_serialization, kSerializationShare});
  }

  SearchOutcome run() {
    if (members_.back().name == MemberName::goal_serialization && members_.size() > 1) {
      if (auto outcome = run(members_.begin(), kOpening)) return std::move(*outcome);
      ++members_.back().turns;
      if (auto outcome = run(members_.end() - 1, kTurn)) return std::move(*outcome);
    }
    while (true) {
      const auto next = std::ranges::min_element(members_, {}, &Member::served);
      ++next->turns;
      if (auto outcome = run(next, kTurn)) return std::move(*outcome);
    }
  }

 private:
  // Returns nothing while the search is not over. A member that has ended without a proof leaves.
  std::optional<SearchOutcome> run(std::vector<Member>::iterator member, std::size_t evaluations) {
    context_.limits.phase(phase_of(member->name));
    if (!member->search) member->search = make(member->name);
    ResumableSearch& search = *member->search;
    auto outcome = search.run(evaluations, bytes() - search.bytes());
    const bool over = outcome && (outcome->plan || search.complete());
    if (outcome && !over) members_.erase(member);
    return over ? std::move(outcome) : std::nullopt;
  }

  std::unique_ptr<ResumableSearch> make(MemberName name) const {
    const auto best_first = [&](ActionCompression compression, bool lookahead) {
      return std::make_unique<BestFirstSearch>(context_, guide_, SearchStyle{compression, lookahead});
    };
    switch (name) {
      case MemberName::lookahead_compressed:
        return best_first(strongest_, true);
      case MemberName::lookahead:
        return best_first(ActionCompression::where_safe, true);
      case MemberName::best_first_width:
        return std::make_unique<BestFirstWidthSearch>(context_, guide_, strongest_);
      case MemberName::goal_alternatives:
        return std::make_unique<GoalAlternatives>(context_, guide_, strongest_);
      case MemberName::step_by_step_compressed:
        return best_first(strongest_, false);
      case MemberName::step_by_step:
        return best_first(ActionCompression::where_safe, false);
      case MemberName::goal_serialization:
        return std::make_unique<GoalSerialization>(context_, guide_, ff_, strongest_);
    }
    return nullptr;
  }

  std::size_t bytes() const {
    std::size_t sum = 0;
    for (const Member& member : members_) {
      if (member.search) sum += member.search->bytes();
    }
    return sum;
  }

  SearchContext context_;
  Guide guide_;
  FfHeuristic& ff_;
  ActionCompression strongest_;
  std::vector<Member> members_;
};

}  // namespace

SearchOutcome search_portfolio(const SearchContext& context, const Guide& guide, FfHeuristic& ff) {
  return Portfolio(context, guide, ff).run();
}

}  // namespace roci::planner::temporal_pddl::search
