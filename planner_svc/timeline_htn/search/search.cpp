#include "planner_svc/timeline_htn/search/search.hpp"

#include <algorithm>

#include "planner_svc/timeline_htn/search/decompositions.hpp"
#include "planner_svc/timeline_htn/search/earliest_times.hpp"

namespace roci::planner::timeline_htn::search {

using model::Model, model::Problem;

namespace {

constexpr std::uint64_t kPollEach = 64;

// Steps after which a problem is hard enough for the relaxed reachability to be looked at.
constexpr std::uint64_t kBeforeReachability = 20'000;

constexpr int kPassWithDetours = 1;
constexpr int kPassThatDropsNothing = 2;
constexpr int kPassWithRounds = 3;
constexpr int kLastPass = 4;  // with rounds, and drops nothing
// Steps that the passes with rounds may take, beside as many as those before them have taken.
constexpr std::uint64_t kLeastForRounds = 20'000;

std::uint64_t mix(std::uint64_t x) {
  x ^= x >> 30U;
  x *= 0xbf58476d1ce4e5b9ULL;
  x ^= x >> 27U;
  x *= 0x94d049bb133111ebULL;
  return x ^ (x >> 31U);
}
std::uint64_t join(std::uint64_t a, std::uint64_t b) { return mix(a * 0x9e3779b97f4a7c15ULL + b + 1); }

}  // namespace

std::vector<Index> goal_order(const Problem& problem) {
  std::vector<Index> left(problem.goals.size()), out;
  for (Index i = 0; i < left.size(); ++i) left[i] = i;
  std::ranges::stable_sort(
      left, {}, [&](Index i) { return std::pair(problem.goals[i].closes, problem.goals[i].opens); });
  while (!left.empty()) {
    const auto next = std::ranges::find_if(left, [&](Index i) {
      return std::ranges::all_of(problem.goals[i].after,
                                 [&](Index before) { return std::ranges::find(out, before) != out.end(); });
    });
    const auto taken = next == left.end() ? left.begin() : next;
    out.push_back(*taken);
    left.erase(taken);
  }
  return out;
}

Search::Search(const Model& model, const Resolver& resolver)
    : ground_(model),
      successors_(ground_, bindings_, resolver.order),
      goals_(goal_order(*model.problem)),
      estimate_(make_estimate(resolver.heuristic, ground_, successors_)) {
  start();
  if (state_ != Outcome::searching) return;
  if (const auto obstacle = out_of_reach()) {
    state_ = Outcome::exhausted;
    obstacle_ = *obstacle;
  } else if (auto late = too_late(ground_, successors_, *plan_)) {
    state_ = Outcome::exhausted;
    never_reached_ = {late->goal, std::move(late->reason)};
  }
}

std::optional<Obstacle> Search::out_of_reach() {
  const auto can_be = [&](StateId state) {
    return ground_.at(state).kind != model::StateKind::complex || successors_.below().derivable(state);
  };
  const Model& model = ground_.model();
  for (const Index g : goals_) {
    const model::Pattern& wanted = model.problem->goals[g].state;
    const StateId from = plan_->tokens()[plan_->current(wanted.component)].state;
    const std::vector<StateId> all = ground_.reachable(from);
    const auto targets = ground_.reachable(from, wanted, {});
    if (targets.empty()) continue;  // the search says what is missing
    const bool within_reach = std::ranges::any_of(targets, [&](StateId target) {
      return target == from || (can_be(target) && std::ranges::any_of(all, [&](StateId before) {
                                  return ground_.may_follow(before, target) && can_be(before);
                                }));
    });
    if (within_reach) continue;
    Obstacle out{Obstacle::Kind::no_behaviour, g, targets.front()};
    if (can_be(targets.front()))
      for (const StateId before : all)
        if (ground_.may_follow(before, targets.front()) && !can_be(before)) out.state = before;
    return out;
  }
  return std::nullopt;
}

void Search::start() {
  plan_ = std::make_unique<PartialPlan>(ground_, bindings_, goals_);
  nodes_.assign(1, {kNone, 0, {}});
  path_.assign(1, 0);
  marks_.assign(1, plan_->mark());
  seen_.clear();
  windows_.clear();
  open_.clear();
  open_[0].push_back(0);
  if (plan_->sound()) return;
  state_ = Outcome::exhausted;
  note(plan_->obstacle());
}

// Brings the plan to a node: back to where the two ways part, then forward.
// Returns false where its last step leads nowhere.
bool Search::go_to(Index node) {
  std::vector<Index> way;
  Index common = node;
  while (nodes_[common].depth >= path_.size() || path_[nodes_[common].depth] != common) {
    way.push_back(common);
    common = nodes_[common].parent;
  }
  const std::size_t depth = nodes_[common].depth;
  if (depth + 1 < path_.size()) {
    plan_->take_back(marks_[depth + 1]);
    path_.resize(depth + 1);
    marks_.resize(depth + 1);
  }
  for (auto one = way.rbegin(); one != way.rend(); ++one) {
    const PartialPlan::Mark mark = plan_->mark();
    if (!plan_->take(nodes_[*one].step)) {
      plan_->take_back(mark);
      return false;
    }
    path_.push_back(*one);
    marks_.push_back(mark);
  }
  return true;
}

// What is left to do and where the timelines stand, without times.
std::uint64_t Search::signature() const {
  const PartialPlan& plan = *plan_;
  std::uint64_t out = 1;
  for (Index c = 0; c < ground_.model().components.size(); ++c) {
    const Token& token = plan.tokens()[plan.current(c)];
    const bool running = token.activity != kNone && !plan.complete(token.activity);
    out = join(out, std::uint64_t{token.state} * 4 + (running ? 1 : 0) + (token.ended != 0 ? 2 : 0));
  }
  for (Index c = 0; ground_.predicted() != 0 && c < ground_.model().components.size(); ++c)
    if (plan.last_window(c) != kNone) out = join(out, plan.last_window(c));
  std::uint64_t open = 0;
  for (const Index index : plan.open()) {
    const Activity& activity = plan.activities()[index];
    std::uint64_t one = join(activity.state, activity.goal);
    if (activity.parent != kNone) {
      const Activity& parent = plan.activities()[activity.parent];
      one = join(join(one, parent.state), join(parent.behaviour, join(parent.binding, activity.subgoal)));
    }
    for (const Index before : plan.before(index)) one = join(one, plan.complete(before) ? 1 : 2);
    if (activity.path_from != kNone) one = join(one, plan.tokens().size() - activity.path_from);
    open += mix(one);
  }
  out = join(out, open);
  for (const Urgent* item = plan.urgent(); item != nullptr; item = plan.below(*item)) {
    out = join(out, join(static_cast<std::uint64_t>(item->kind), join(item->need, item->goal)));
    const bool activity = item->kind == UrgentKind::decompose || item->kind == UrgentKind::condition;
    const StateId subject =
        activity ? plan.activities()[item->subject].state : plan.tokens()[item->subject].state;
    out = join(out, subject);
  }
  return out;
}

bool Search::is_hopeless(std::size_t memory_bytes, const std::function<bool()>& cancelled) {
  if (!looked_at_) {
    const std::size_t used = bytes();
    if (memory_bytes > used)
      never_reached_ = never_reached(ground_.model(), memory_bytes - used, cancelled);
    else if (memory_bytes == 0)
      never_reached_ = never_reached(ground_.model(), ~std::size_t{0}, cancelled);
    looked_at_ = true;
  }
  return never_reached_.has_value();
}

bool Search::drops_nothing() const { return pass_ == kPassThatDropsNothing || pass_ == kLastPass; }

// The next pass that finds what those so far have left out; this one: none does.
int Search::pass_to_come() const {
  const bool late = plan_->refusals_by_time() > 0 || successors_.passed_by();
  const bool dropped = late && count_.repeated > repeated_before_;
  if (pass_ < kPassWithDetours && successors_.left_out()) return kPassWithDetours;
  if (pass_ < kPassThatDropsNothing && dropped) return kPassThatDropsNothing;
  if (pass_ < kPassWithRounds && late && successors_.round_left_out()) return kPassWithRounds;
  return pass_ == kPassWithRounds && dropped ? kLastPass : pass_;
}

bool Search::is_later_for_nothing(const Node& node) const {
  if (windows_.empty() || drops_nothing() || node.parent == kNone) return false;
  const auto windows = windows_.find(node.parent);
  return windows != windows_.end() && node.step.first != windows->second.first &&
         plan_->refusals_by_time() == windows->second.refusals;
}

// Starts again with what the pass before has left out.
void Search::next_pass() {
  pass_ = pass_to_come();
  repeated_before_ = count_.repeated;
  successors_.permit_detours();
  if (pass_ == kPassWithRounds) {
    successors_.permit_rounds();
    rounds_until_ = 2 * count_.evaluated + kLeastForRounds;
  }
  start();
}

// Keeps what was met farthest. The first pass tells it best: later ones try what nobody would mean.
void Search::note(const Obstacle& obstacle) {
  if (obstacle.kind == Obstacle::Kind::none) return;
  const std::size_t depth = path_.size();
  if (obstacle_.kind != Obstacle::Kind::none && (pass_ > 0 || depth <= farthest_)) return;
  farthest_ = depth;
  obstacle_ = obstacle;
  waited_for_.reset();
  for (Index c = 0; c < ground_.model().components.size(); ++c) {
    if (plan_->last_window(c) == kNone) continue;
    const Token& window = plan_->tokens()[plan_->last_window(c)];
    const Duration from = plan_->network().earliest(window.start);
    if (!waited_for_ || waited_for_->second < from) waited_for_ = {window.state, from};
  }
}

// Whether a token of the plan is of a timeline that is predicted.
bool Search::is_predicted(Index token) const {
  return ground_.is_predicted(ground_.at(plan_->tokens()[token].state).state.component);
}

void Search::expand(Index node) {
  ++count_.expanded;
  const std::uint32_t estimate = estimate_->of(*plan_);
  if (estimate == kNone) return;
  successors_.of(*plan_, steps_);
  if (steps_.empty()) note(successors_.obstacle());
  const bool window = steps_.size() > 1 &&
                      (steps_.front().kind == StepKind::condition_here ||
                       (steps_.front().kind == StepKind::need_here && is_predicted(steps_.front().first)));
  if (window) windows_[node] = {steps_.front().first, plan_->refusals_by_time()};
  const Index depth = nodes_[node].depth + 1;
  auto& bucket = open_[estimate];
  for (auto step = steps_.rbegin(); step != steps_.rend(); ++step) {
    bucket.push_back(static_cast<Index>(nodes_.size()));
    nodes_.push_back({node, depth, *step});
  }
}

Outcome Search::run(std::uint64_t evaluations, std::size_t memory_bytes,
                    const std::function<bool()>& cancelled) {
  while (state_ == Outcome::searching && count_.evaluated < evaluations) {
    if (count_.evaluated % kPollEach == 0) {
      count_.bytes = bytes();
      if (cancelled()) return Outcome::cancelled;
      if (memory_bytes != 0 && count_.bytes > memory_bytes) return state_ = Outcome::out_of_memory;
    }
    while (!open_.empty() && open_.begin()->second.empty()) open_.erase(open_.begin());
    if (open_.empty()) {
      if (pass_to_come() == pass_ || is_hopeless(memory_bytes, cancelled)) return state_ = Outcome::exhausted;
      next_pass();
      continue;
    }
    if (pass_ >= kPassWithRounds && count_.evaluated >= rounds_until_) return state_ = Outcome::exhausted;
    if (count_.evaluated == kBeforeReachability && is_hopeless(memory_bytes, cancelled))
      return state_ = Outcome::exhausted;
    const Index node = open_.begin()->second.back();
    open_.begin()->second.pop_back();
    ++count_.evaluated;
    if (is_later_for_nothing(nodes_[node])) {
      ++count_.repeated;
      continue;
    }
    if (!go_to(node)) {
      ++count_.refused;
      note(plan_->obstacle());
      continue;
    }
    if (!drops_nothing() && !seen_.insert(signature()).second) {
      ++count_.repeated;
      continue;
    }
    if (Successors::whole(*plan_, ground_)) {
      const PartialPlan::Mark mark = plan_->mark();
      if (plan_->close()) {
        state_ = Outcome::solved;
        break;
      }
      plan_->take_back(mark);
      continue;
    }
    expand(node);
  }
  count_.nodes = nodes_.size();
  count_.bytes = bytes();
  return state_;
}

std::size_t Search::bytes() const {
  return nodes_.capacity() * sizeof(Node) + seen_.size() * 40 + windows_.size() * 48 + plan_->bytes() +
         ground_.bytes() + bindings_.bytes() + marks_.capacity() * sizeof(PartialPlan::Mark);
}

Index Search::blocking_goal() const { return never_reached_ ? never_reached_->goal : obstacle_.goal; }

// Names what must hold of the predicted timeline, and the first times at which it does.
std::string Search::reason_of_window(const Obstacle& one) const {
  constexpr int kNamed = 3;
  const Model& model = ground_.model();
  const std::string wanted = one.state == kNone ? "the plan" : ground_.text(one.state);
  std::string out;
  const model::Pattern* needed = nullptr;
  bool negated = false;
  std::vector<model::Variable> scope;
  if (one.behaviour != kNone) {
    const model::Behaviour& behaviour = model.behaviours[one.behaviour];
    needed = &behaviour.conditions[one.condition].state;
    negated = behaviour.conditions[one.condition].negated;
    scope = behaviour.variables;
    out = "behaviour '" + behaviour.name + "' for " + wanted + " asks for ";
  } else {
    const model::State& state = ground_.definition(one.state);
    needed = &state.needs[one.condition].state;
    scope = state.parameters;
    scope.insert(scope.end(), state.free.begin(), state.free.end());
    out = wanted + " needs ";
  }
  out += (negated ? "not " : "") + to_text(model, *needed, scope);
  std::string times;
  int named = 0;
  const std::vector<Index> open(scope.size(), kNone);
  for (const Index token : plan_->predicted(needed->component)) {
    const Token& value = plan_->tokens()[token];
    if (ground_.fits(value.state, *needed, open) == negated) continue;
    if (++named > kNamed) break;
    times += (named == 1 ? "" : ", ") + temporal::to_text(plan_->network().earliest(value.start)) + " to " +
             temporal::to_text(plan_->network().earliest(value.end));
  }
  if (named == 0) return out + ", and that is predicted for no time";
  return out + ", and no time at which that is predicted is left for it: " + times +
         (named > kNamed ? ", …" : "");
}

std::string Search::reason() const {
  if (never_reached_) return never_reached_->reason;
  const Model& model = ground_.model();
  const Obstacle& one = obstacle_;
  const auto wanted = [&] { return one.state == kNone ? std::string("the plan") : ground_.text(one.state); };
  const auto behaviour = [&] { return "behaviour '" + model.behaviours[one.behaviour].name + "'"; };
  switch (one.kind) {
    case Obstacle::Kind::none:
      return "no plan was found";
    case Obstacle::Kind::time:
      return "time does not permit " + wanted() + (one.behaviour == kNone ? "" : " by " + behaviour()) +
             ": its window, the constraints round it or the horizon are too narrow" +
             (waited_for_ && waited_for_->second > Duration{0}
                  ? ", and " + ground_.text(waited_for_->first) +
                        ", which is needed before, is predicted from " +
                        temporal::to_text(waited_for_->second) + " on"
                  : "");
    case Obstacle::Kind::condition: {
      const auto& condition = model.behaviours[one.behaviour].conditions[one.condition];
      return behaviour() + " for " + wanted() + " asks for " + (condition.negated ? "not " : "") +
             to_text(model, condition.state, model.behaviours[one.behaviour].variables) +
             ", and the timeline is in " + ground_.text(one.at);
    }
    case Obstacle::Kind::no_behaviour:
      return "no behaviour achieves " + wanted() + " with these objects";
    case Obstacle::Kind::no_path:
      return one.state == kNone ? "nothing leads from " + ground_.text(one.at) + " to a state to rest in"
                                : "no transitions lead from " + ground_.text(one.at) + " to " + wanted();
    case Obstacle::Kind::no_state:
      return behaviour() + " for " + wanted() + " has a subgoal, '" +
             model.behaviours[one.behaviour].subgoals[one.condition].name +
             "', that does not exist with these objects, or stands on a timeline that is taken by what it "
             "belongs to";
    case Obstacle::Kind::recursion:
      return behaviour() + " leads back to " + wanted();
    case Obstacle::Kind::need: {
      const auto& state = ground_.definition(one.state);
      std::vector<model::Variable> scope = state.parameters;
      scope.insert(scope.end(), state.free.begin(), state.free.end());
      return wanted() + " needs " + to_text(model, state.needs[one.condition].state, scope) +
             ", and the timeline, in " + ground_.text(one.at) + ", cannot come there";
    }
    case Obstacle::Kind::window:
      return reason_of_window(one);
  }
  return "no plan was found";
}

}  // namespace roci::planner::timeline_htn::search
