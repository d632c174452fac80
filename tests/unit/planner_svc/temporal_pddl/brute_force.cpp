#include "tests/unit/planner_svc/temporal_pddl/brute_force.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

namespace roci::planner::temporal_pddl::testing {

namespace {

using temporal::Duration;

constexpr long kEpsilon = 1;
constexpr long kSecond = 1000;  // in units of ε
constexpr long kNone = std::numeric_limits<long>::min() / 4;

struct State {
  std::set<std::string> facts;
  double x = 0;
};

std::string of(const pddl::Atom& atom) { return atom.symbol; }

// Derived predicates by name; they depend on one another without circles.
using Rules = std::multimap<std::string, pddl::Condition>;

bool holds(const pddl::Condition& condition, const State& state, const Rules& rules) {
  const auto part_holds = [&](const pddl::Condition& part) { return holds(part, state, rules); };
  if (const auto* all = std::get_if<pddl::And>(&condition.node)) {
    return std::ranges::all_of(all->parts, part_holds);
  }
  if (const auto* any = std::get_if<pddl::Or>(&condition.node)) {
    return std::ranges::any_of(any->parts, part_holds);
  }
  if (const auto* negation = std::get_if<pddl::Not>(&condition.node)) return !part_holds(*negation->body);
  if (const auto* atom = std::get_if<pddl::Atom>(&condition.node)) {
    const auto [begin, end] = rules.equal_range(of(*atom));
    return state.facts.contains(of(*atom)) ||
           std::any_of(begin, end, [&](const auto& rule) { return part_holds(rule.second); });
  }
  const auto& comparison = std::get<pddl::Comparison>(condition.node);
  const double bound = std::get<pddl::Number>(comparison.right.node).value;
  return comparison.op == pddl::ComparisonOperator::greater_equal ? state.x >= bound : state.x <= bound;
}

void collect_reads(const pddl::Condition& condition, const Rules& rules, std::set<std::string>& reads) {
  const auto collect_all = [&](const std::vector<pddl::Condition>& parts) {
    for (const auto& part : parts) collect_reads(part, rules, reads);
  };
  if (const auto* all = std::get_if<pddl::And>(&condition.node)) {
    collect_all(all->parts);
  } else if (const auto* any = std::get_if<pddl::Or>(&condition.node)) {
    collect_all(any->parts);
  } else if (const auto* negation = std::get_if<pddl::Not>(&condition.node)) {
    collect_reads(*negation->body, rules, reads);
  } else if (const auto* atom = std::get_if<pddl::Atom>(&condition.node)) {
    const auto [begin, end] = rules.equal_range(of(*atom));
    for (auto rule = begin; rule != end; ++rule) collect_reads(rule->second, rules, reads);
    if (begin == end) reads.insert(of(*atom));
  } else {
    reads.insert("x");
  }
}

struct Happening {
  pddl::Condition condition;
  std::vector<pddl::Effect> effects;
  std::set<std::string> reads, writes;

  void complete(const Rules& rules) {
    collect_reads(condition, rules, reads);
    for (const auto& effect : effects) {
      const auto* literal = std::get_if<pddl::Literal>(&effect.node);
      writes.insert(literal ? of(literal->atom) : "x");
    }
  }
  State apply(const State& before) const {
    State after = before;
    for (const auto& effect : effects) {
      if (const auto* assignment = std::get_if<pddl::Assignment>(&effect.node)) {
        const double value = std::get<pddl::Number>(assignment->value.node).value;
        if (assignment->op == pddl::AssignmentOperator::assign) after.x = value;
        if (assignment->op == pddl::AssignmentOperator::increase) after.x += value;
        if (assignment->op == pddl::AssignmentOperator::decrease) after.x -= value;
      } else if (std::get<pddl::Literal>(effect.node).negated) {
        after.facts.erase(of(std::get<pddl::Literal>(effect.node).atom));
      }
    }
    for (const auto& effect : effects) {
      const auto* literal = std::get_if<pddl::Literal>(&effect.node);
      if (literal && !literal->negated) after.facts.insert(of(literal->atom));
    }
    return after;
  }
  bool interferes(const Happening& other) const {
    const auto meet = [](const auto& a, const auto& b) {
      return std::ranges::any_of(a, [&](const auto& item) { return b.contains(item); });
    };
    return meet(writes, other.writes) || meet(writes, other.reads) || meet(reads, other.writes);
  }
};

struct Doing {
  std::optional<Happening> end;  // none: a plain action
  Happening start;
  pddl::Condition over_all;
  long least = 0;
  long most = 0;
};

class Search {
 public:
  Search(const Model& model, std::size_t max_actions) : goal_(model.problem.goal), left_(max_actions) {
    for (const auto& derived : model.domain.derived) rules_.emplace(derived.head.name, derived.body);
    for (const auto& action : model.domain.actions) {
      Doing doing;
      doing.start = {action.precondition, action.effects, {}, {}};
      doing.start.complete(rules_);
      doings_.push_back(std::move(doing));
    }
    for (const auto& action : model.domain.durative_actions) {
      Doing doing;
      doing.start = {action.condition.at_start, action.start_effects, {}, {}};
      doing.start.complete(rules_);
      doing.end = Happening{action.condition.at_end, action.end_effects, {}, {}};
      doing.end->complete(rules_);
      doing.over_all = action.condition.over_all;
      doing.most = std::numeric_limits<long>::max();
      for (const auto& rule : action.duration) {
        const long bound = static_cast<long>(std::get<pddl::Number>(rule.bound.node).value) * kSecond;
        if (rule.op != pddl::ComparisonOperator::less_equal) doing.least = std::max(doing.least, bound);
        if (rule.op != pddl::ComparisonOperator::greater_equal) doing.most = std::min(doing.most, bound);
      }
      doings_.push_back(std::move(doing));
    }
    for (const auto& timed : model.problem.timed_literals) {
      pddl::Effect effect;
      effect.node = timed.literal;
      Happening happening{{}, {effect}, {}, {}};
      happening.complete(rules_);
      timed_.emplace_back(static_cast<long>(timed.time) * kSecond, happening);
    }
    for (const auto& fact : model.problem.facts) first_.facts.insert(of(fact));
    for (const auto& value : model.problem.values) first_.x = value.value;
    running_.assign(doings_.size(), kIdle);
  }

  bool run() { return extend(first_); }
  // In units of ε, of all plans; none: there are none.
  std::optional<long> best() {
    all_ = true;
    extend(first_);
    return best_;
  }

 private:
  static constexpr std::size_t kIdle = std::numeric_limits<std::size_t>::max();

  // Appends a happening at the end of the order and leaves it there if the times still fit together.
  bool push(const Happening& happening) {
    const std::size_t n = happenings_.size() + 1;  // its time point; 0 is the origin
    auto grown = bounds_;
    for (auto& row : grown) row.push_back(kNone);
    grown.emplace_back(n + 1, kNone);
    grown[n][n] = 0;
    bounds_.swap(grown);
    saved_.push_back(std::move(grown));
    happenings_.push_back(&happening);
    bool fits = require(n - 1, n, 0);
    for (std::size_t i = 1; i < n; ++i) {
      if (happenings_[i - 1]->interferes(happening)) fits = fits && require(i, n, kEpsilon);
    }
    return fits;
  }
  void pop() {
    bounds_ = std::move(saved_.back());
    saved_.pop_back();
    happenings_.pop_back();
  }

  // t(to) − t(from) ≥ least, with all that follows from it; false: a contradiction.
  bool require(std::size_t from, std::size_t to, long least) {
    if (least <= bounds_[from][to]) return true;
    for (std::size_t i = 0; i < bounds_.size(); ++i) {
      for (std::size_t j = 0; j < bounds_.size(); ++j) {
        if (bounds_[i][from] == kNone || bounds_[to][j] == kNone) continue;
        bounds_[i][j] = std::max(bounds_[i][j], bounds_[i][from] + least + bounds_[to][j]);
      }
    }
    return bounds_[from][from] <= 0;
  }

  bool invariants_hold(const State& state) const {
    for (std::size_t i = 0; i < doings_.size(); ++i) {
      if (running_[i] != kIdle && !holds(doings_[i].over_all, state, rules_)) return false;
    }
    return true;
  }

  bool is_goal(const State& state) {
    const bool idle = std::ranges::all_of(running_, [](std::size_t since) { return since == kIdle; });
    if (!idle || !holds(goal_, state, rules_) || !ends_with_an_action()) return false;
    if (next_timed_ == timed_.size() || happenings_.empty()) return true;
    return require(happenings_.size(), 0, -(timed_[next_timed_].first - kEpsilon));
  }

  // What happens after the last action does not count for the goal; at the same moment it does.
  bool ends_with_an_action() {
    std::size_t last = happenings_.size();
    while (last > 0 && is_timed(happenings_[last - 1])) --last;
    if (last == happenings_.size()) return true;
    return last > 0 && require(happenings_.size(), last, 0);
  }
  bool is_timed(const Happening* happening) const {
    return std::ranges::any_of(timed_, [&](const auto& timed) { return &timed.second == happening; });
  }

  long makespan() const {
    std::size_t last = happenings_.size();
    while (last > 0 && is_timed(happenings_[last - 1])) --last;
    return bounds_[0][last];
  }

  bool extend(const State& state) {
    const auto bounds = bounds_;
    if (is_goal(state)) {
      if (!all_) return true;
      best_ = std::min(best_.value_or(std::numeric_limits<long>::max()), makespan());
    }
    bounds_ = bounds;
    return extend_by_timed(state) || extend_by_starts(state) || extend_by_ends(state);
  }

  bool extend_by_timed(const State& state) {
    if (next_timed_ == timed_.size()) return false;
    const auto& [time, happening] = timed_[next_timed_];
    bool found = false;
    if (push(happening) && require(0, happenings_.size(), time) && require(happenings_.size(), 0, -time)) {
      const State after = happening.apply(state);
      ++next_timed_;
      found = invariants_hold(after) && extend(after);
      --next_timed_;
    }
    pop();
    return found;
  }

  bool extend_by_starts(const State& state) {
    if (left_ == 0) return false;
    --left_;
    bool found = false;
    for (std::size_t i = 0; i < doings_.size() && !found; ++i) {
      if (running_[i] != kIdle || !holds(doings_[i].start.condition, state, rules_)) continue;
      if (push(doings_[i].start)) {
        const State after = doings_[i].start.apply(state);
        if (doings_[i].end) running_[i] = happenings_.size();
        found = invariants_hold(after) && extend(after);
        running_[i] = kIdle;
      }
      pop();
    }
    ++left_;
    return found;
  }

  bool extend_by_ends(const State& state) {
    bool found = false;
    for (std::size_t i = 0; i < doings_.size() && !found; ++i) {
      if (running_[i] == kIdle || !holds(doings_[i].end->condition, state, rules_)) continue;
      const std::size_t since = running_[i];
      if (push(*doings_[i].end) && require(since, happenings_.size(), doings_[i].least) &&
          require(happenings_.size(), since, -doings_[i].most)) {
        running_[i] = kIdle;
        const State after = doings_[i].end->apply(state);
        found = invariants_hold(after) && extend(after);
        running_[i] = since;
      }
      pop();
    }
    return found;
  }

  bool all_ = false;
  std::optional<long> best_;
  Rules rules_;
  pddl::Condition goal_;
  std::size_t left_;
  std::vector<Doing> doings_;
  std::vector<std::pair<long, Happening>> timed_;
  State first_;
  std::size_t next_timed_ = 0;
  std::vector<std::size_t> running_;  // by doing: its start's time point, or kIdle
  std::vector<const Happening*> happenings_;
  std::vector<std::vector<long>> bounds_{{0}};
  std::vector<std::vector<std::vector<long>>> saved_;
};

}  // namespace

bool has_plan(const Model& model, std::size_t max_actions) { return Search(model, max_actions).run(); }

std::optional<Duration> best_makespan(const Model& model, std::size_t max_actions) {
  const std::optional<long> best = Search(model, max_actions).best();
  if (!best) return std::nullopt;
  return Duration{*best * 1'000'000 / kSecond};
}

}  // namespace roci::planner::temporal_pddl::testing
