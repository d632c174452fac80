#include "planner_svc/timeline_htn/search/relaxed_reachability.hpp"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

#include "planner_svc/timeline_htn/search/decompositions.hpp"
#include "planner_svc/timeline_htn/search/last_states.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"
#include "planner_svc/timeline_htn/search/transition_graph.hpp"

namespace roci::planner::timeline_htn::search {

using model::Behaviour, model::NeedKind, model::Pattern, model::StateKind;

namespace {

constexpr int kMostRounds = 8;
constexpr std::size_t kNamed = 3;  // states that a reason names

class Relaxation {
 public:
  Relaxation(const model::Model& model, std::size_t most_bytes, const std::function<bool()>& cancelled)
      : model_(model),
        most_bytes_(most_bytes),
        cancelled_(cancelled),
        ground_(model),
        successors_(ground_, bindings_, Order::first_declared),
        timelines_(model.components.size()) {
    for (const auto& component : model.components)
      for (const auto& state : component.states)
        for (const auto& need : state.needs)
          if (need.kind == NeedKind::met_by)
            left_for_another_.emplace(need.state.component, need.state.state);
  }

  std::optional<NeverReached> run() {
    const PartialPlan plan(ground_, bindings_, goal_order(*model_.problem));
    if (!plan.sound()) return std::nullopt;
    for (Index c = 0; c < model_.components.size(); ++c) {
      timelines_[c].initial = plan.tokens()[plan.begun(c)].state;
      timelines_[c].predicted = model::is_predicted(model_, c);
      if (timelines_[c].predicted)
        for (const Index token : plan.predicted(c)) timelines_[c].known.push_back(plan.tokens()[token].state);
    }
    for (Index cause = 0; cause < plan.mending_count(); ++cause) {
      tasks_.push_back({kNone, 0, {}, true, false});
      task_ways_.clear();
      for (const auto& [behaviour, binding] : plan.mending(cause))
        add_way(tasks_.back(), behaviour, bindings_.at(binding));
    }
    causes_ = tasks_.size();
    for (int round = 0; round < kMostRounds; ++round) {
      start();
      if (!propagate()) return std::nullopt;
      if (auto out = unmet()) return out;
      if (!leave_out()) break;
    }
    if (causes_ == 0) return std::nullopt;
    start(false);
    if (!propagate() || !start_mended() || !propagate()) return std::nullopt;
    return unmet();
  }

 private:
  /// Is one behaviour with its objects. Objects that neither parts nor conditions hold are left open.
  struct Way {
    Index behaviour = 0;
    std::vector<Index> objects;
    std::vector<StateId> parts;
    bool left_out = false;
    bool begun = false;
  };
  /// Is a complex state below states of these components, or a behaviour that is triggered.
  struct Task {
    StateId state = kNone;
    ComponentSet above = 0;
    std::vector<Way> ways;
    bool known = false;  ///< its ways
    bool done = false;
    bool asked = true;  ///< for the goals, where errors are mended before
  };
  /// Is a group of states that are asked for and that the same states lead to.
  struct Wish {
    Index part = 0;  // of the transition graph
    bool by_complex = true;
    ComponentSet above = 0;
    StateId only = kNone;
    bool also_from_itself = false;
  };
  struct Timeline {
    StateId initial = kNone;
    bool predicted = false;
    std::vector<StateId> known;  // that are predicted, with the initial one
    std::optional<TransitionGraph> graph;
    std::vector<StateId> reached;
    std::vector<StateId> earlier;  // reached while errors are mended
    std::vector<Wish> wishes;
    Index changes = 0;  // of the wishes
  };
  struct Mark {
    bool reached = false;
    bool earlier = false;  // reached while errors are mended
    bool over =
        false;  // complex, complete before the goals begin: it may be left, its parts come about no more
    bool done = false;      // of a complex state
    bool left_out = false;  // in no plan
    bool left = false;      // what follows without a wish was added
    Index changes = 0;      // of the wishes that were followed
  };

  Mark& mark(StateId state) {
    if (state >= marks_.size()) marks_.resize(state + 1);
    return marks_[state];
  }
  Index component(StateId state) const { return ground_.at(state).state.component; }
  StateKind kind(StateId state) const { return ground_.at(state).kind; }
  bool is_complex(StateId state) const { return kind(state) == StateKind::complex; }
  static ComponentSet bit(Index component) { return ComponentSet{1} << component; }

  const TransitionGraph& graph(Index component) {
    Timeline& timeline = timelines_[component];
    if (!timeline.graph) timeline.graph.emplace(ground_, timeline.initial);
    return *timeline.graph;
  }

  // With the goals, or with what mends errors alone.
  void start(bool with_goals = true) {
    for (Mark& one : marks_) one = {.left_out = one.left_out};
    forget_tasks(0, with_goals);
    for (Timeline& timeline : timelines_) {
      timeline.reached = {timeline.initial};
      timeline.wishes.clear();
      timeline.changes = 0;
      mark(timeline.initial).reached = true;
      for (const StateId state : timeline.known)
        if (!std::exchange(mark(state).reached, true)) timeline.reached.push_back(state);
    }
    if (with_goals) ask_for_goals();
  }

  void ask_for_goals() {
    for (const model::Goal& goal : model_.problem->goals) ask_for(ground_.find(ground_of(goal.state, {})), 0);
  }

  // All but what is triggered comes about anew, and where it is not asked for (false) only if it is from now on.
  void forget_tasks(std::size_t first, bool asked) {
    for (std::size_t t = first; t < tasks_.size(); ++t) {
      tasks_[t].done = false;
      tasks_[t].asked = asked || t < causes_;
      for (Way& way : tasks_[t].ways) way.begun = false;
    }
  }

  // Begins again where all that mends errors is complete: the goals come after that (false: nothing was mended).
  // A timeline whose last state is known goes on from there; the others from wherever they came to. What was there
  // earlier may still meet a need, or a goal to rest, if it ended just then.
  bool start_mended() {
    LastStates last(ground_, successors_);
    std::vector<std::vector<StateId>> begin(timelines_.size());
    bool known = false;
    for (Index c = 0; c < timelines_.size(); ++c) {
      const auto left = timelines_[c].predicted ? std::nullopt : left_by_mending(last, c);
      known = known || left;
      begin[c] = left.value_or(timelines_[c].reached);
    }
    if (!known) return false;
    for (Mark& one : marks_) one = {.earlier = one.reached, .done = one.done, .left_out = one.left_out};
    forget_tasks(causes_, false);
    for (Index c = 0; c < timelines_.size(); ++c) {
      Timeline& timeline = timelines_[c];
      timeline.earlier = std::exchange(timeline.reached, std::move(begin[c]));
      timeline.wishes.clear();
      timeline.changes = 0;
      for (const StateId state : timeline.reached) {
        mark(state).reached = true;
        mark(state).over = is_complex(state);
      }
    }
    ask_for_goals();
    return true;
  }

  // Where a timeline can stand then: where the last of what mends one cause or another has left it, or where it began.
  std::optional<std::vector<StateId>> left_by_mending(LastStates& last, Index component) {
    std::set<StateId> out;
    bool may_stay = true;
    for (std::size_t cause = 0; cause < causes_; ++cause) {
      bool stays = false;
      for (const Way& way : tasks_[cause].ways) {
        const auto done = [&](StateId part) { return is_done(part, 0); };
        if (!way.begun || way.left_out || !std::ranges::all_of(way.parts, done)) continue;
        const LastStates::Left left = last.of(way.behaviour, way.parts, component);
        if (left.touched && !left.states) return std::nullopt;
        stays = stays || !left.touched;
        for (const StateId state : left.states.value_or(std::vector<StateId>{}))
          if (mark(state).reached) out.insert(state);
      }
      may_stay = may_stay && stays;
    }
    if (may_stay) out.insert(timelines_[component].initial);
    return std::vector<StateId>(out.begin(), out.end());
  }

  // Goes on until nothing is added; false: it was cancelled, or takes too much memory.
  bool propagate() {
    for (bool more = true; more;) {
      more = false;
      for (Timeline& timeline : timelines_)
        for (std::size_t i = 0; !timeline.predicted && i < timeline.reached.size(); ++i) {
          if (steps_++ % 1024 == 0 && (bytes() > most_bytes_ || cancelled_())) return false;
          more = go_on(timeline, timeline.reached[i]) || more;
        }
      for (std::size_t t = 0; t < tasks_.size(); ++t) {
        if (steps_++ % 64 == 0 && (bytes() > most_bytes_ || cancelled_())) return false;
        more = carry_out(t) || more;
      }
    }
    return true;
  }

  bool reach(StateId state) {
    if (mark(state).reached) return std::exchange(mark(state).over, false);
    if (mark(state).left_out) return false;
    mark(state).reached = true;
    timelines_[component(state)].reached.push_back(state);
    const model::State& definition = ground_.definition(state);
    std::vector<Index> variables = ground_.at(state).state.objects;
    variables.resize(variables.size() + definition.free.size(), kNone);
    for (const model::Need& need : definition.needs)
      for (const StateId other : graph(need.state.component).states())
        if (ground_.fits(other, need.state, variables) && !is_complex(other)) wish(other, false, 0);
    return true;
  }

  void wish(StateId state, bool by_complex, ComponentSet above) {
    Timeline& timeline = timelines_[component(state)];
    if (timeline.predicted) return;
    const Index part = graph(component(state)).part(state);
    if (part == kNone) return;
    const bool itself = kind(state) != StateKind::resting || is_left_for_another(state);
    const auto same = std::ranges::find_if(timeline.wishes, [&](const Wish& one) {
      return one.part == part && one.by_complex == by_complex && one.above == above;
    });
    if (same == timeline.wishes.end()) {
      timeline.wishes.push_back({part, by_complex, above, state, itself});
    } else if (!same->also_from_itself && (itself || same->only != state)) {
      same->also_from_itself = true;
    } else {
      return;
    }
    ++timeline.changes;
  }

  bool is_left_for_another(StateId state) const {
    return left_for_another_.contains({component(state), ground_.at(state).state.state});
  }

  // What may follow a state that is reached.
  bool go_on(Timeline& timeline, StateId from) {
    if (is_complex(from) && from != timeline.initial && !mark(from).done) return false;
    const bool leaves = !mark(from).left;
    if (!leaves && mark(from).changes == timeline.changes) return false;
    mark(from).left = true;
    mark(from).changes = timeline.changes;
    bool more = false;
    const std::vector<StateId> next = ground_.next(from);
    if (leaves && (kind(from) == StateKind::simple || is_complex(from) || is_left_for_another(from)))
      for (const StateId after : next) more = (!is_complex(after) && reach(after)) || more;
    if (leaves && kind(from) == StateKind::simple) more = go_on_by_itself(from) || more;
    for (std::size_t w = 0; w < timeline.wishes.size(); ++w) {
      const Wish one = timeline.wishes[w];
      if (one.only == from && !one.also_from_itself) continue;
      const std::vector<bool>& leads = timeline.graph->leading_to(one.part);
      for (const StateId after : next) {
        if (!leads[timeline.graph->part(after)] || (is_complex(after) && !one.by_complex)) continue;
        more = reach(after) || more;
        if (is_complex(after) && !mark(after).left_out) more = add_task(after, one.above) || more;
      }
    }
    return more;
  }

  bool go_on_by_itself(StateId from) {
    bool more = false;
    std::vector<StateId> last{from};
    for (std::size_t step = 0; step < kStepsByItself; ++step) {
      std::vector<StateId> now;
      for (const StateId one : last)
        for (const StateId after : std::vector<StateId>(ground_.next(one)))
          if (!is_complex(after) && !ground_.definition(after).command) now.push_back(after);
      for (const StateId after : now) more = reach(after) || more;
      last = std::move(now);
    }
    return more;
  }

  bool add_task(StateId state, ComponentSet above) {
    const auto [entry, added] = task_of_.emplace(std::pair(state, above), tasks_.size());
    if (!added) return !std::exchange(tasks_[entry->second].asked, true);
    tasks_.push_back({state, above, {}, false, false});
    return true;
  }

  // A goal, or a part of what lies below states of these components.
  void ask_for(StateId state, ComponentSet above) {
    if (is_complex(state)) add_task(state, above);
    if ((above & bit(component(state))) == 0) wish(state, true, above);
  }

  void add_way(Task& task, Index index, const std::vector<Index>& objects) {
    const Behaviour& behaviour = model_.behaviours[index];
    std::set<Index> beside;
    for (const model::Decision& decision : behaviour.decisions)
      for (std::size_t choice = 1; choice < decision.choices.size(); ++choice)
        beside.insert(decision.choices[choice].subgoals.begin(), decision.choices[choice].subgoals.end());
    Way way{index, std::vector<Index>(objects.size(), kNone), {}};
    const auto use = [&](const Pattern& pattern) {
      for (const model::Term& term : pattern.terms)
        if (!term.object) way.objects[term.index] = objects[term.index];
    };
    for (Index s = 0; s < behaviour.subgoals.size(); ++s)
      if (!beside.contains(s)) use(behaviour.subgoals[s].state);
    for (const model::Precondition& condition : behaviour.conditions) use(condition.state);
    if (!task_ways_.emplace(index, way.objects).second) return;
    for (Index s = 0; s < behaviour.subgoals.size(); ++s) {
      if (beside.contains(s)) continue;
      const StateId part = ground_.find(ground_of(behaviour.subgoals[s].state, objects));
      if (part == kNone) return;
      const bool nested = (below(task) & bit(component(part))) != 0;
      if (nested && !is_complex(part)) return;
      way.parts.push_back(part);
    }
    if (task.state == kNone || successors_.below().derivable(index, objects))
      task.ways.push_back(std::move(way));
    way_bytes_ += 120;
  }

  ComponentSet below(const Task& task) const {
    return task.state == kNone ? 0 : task.above | bit(component(task.state));
  }

  void find_ways(Task& task) {
    task.known = true;
    task_ways_.clear();
    const model::GroundState state = ground_.at(task.state).state;
    for (const Index behaviour : successors_.behaviours(state.component, state.state))
      for (const auto& objects : successors_.ways(behaviour, task.state)) add_way(task, behaviour, objects);
    task_ways_.clear();
  }

  bool fits(const model::Precondition& condition, const std::vector<Index>& objects) const {
    return std::ranges::any_of(timelines_[condition.state.component].reached, [&](StateId state) {
      return ground_.fits(state, condition.state, objects) != condition.negated;
    });
  }

  bool begins(StateId state, ComponentSet above) {
    return state == kNone || (above & bit(component(state))) != 0 ||
           (mark(state).reached && !mark(state).over);
  }

  bool is_done(StateId part, ComponentSet above) {
    if (!is_complex(part))
      return mark(part).reached || (mark(part).earlier && kind(part) == StateKind::resting);
    const auto task = task_of_.find({part, above});
    return task != task_of_.end() && tasks_[task->second].done;
  }

  bool carry_out(std::size_t index) {
    if (tasks_[index].done || !tasks_[index].asked || !begins(tasks_[index].state, tasks_[index].above))
      return false;
    if (!tasks_[index].known) find_ways(tasks_[index]);
    const ComponentSet above = below(tasks_[index]);
    bool more = false;
    for (std::size_t w = 0; w < tasks_[index].ways.size(); ++w) {
      if (tasks_[index].ways[w].left_out) continue;
      if (!tasks_[index].ways[w].begun) {
        const Way& way = tasks_[index].ways[w];
        const auto& conditions = model_.behaviours[way.behaviour].conditions;
        if (!std::ranges::all_of(conditions, [&](const auto& one) { return fits(one, way.objects); }))
          continue;
        more = tasks_[index].ways[w].begun = true;
        for (const StateId part : std::vector<StateId>(way.parts)) ask_for(part, above);
      }
      Task& task = tasks_[index];
      if (task.done || !std::ranges::all_of(task.ways[w].parts, [&](StateId p) { return is_done(p, above); }))
        continue;
      more = task.done = true;
      if (task.state != kNone) mark(task.state).done = true;
    }
    return more;
  }

  // What began and cannot come about; false: nothing did.
  bool leave_out() {
    bool more = false;
    for (Task& task : tasks_)
      for (Way& way : task.ways) {
        const auto done = [&](StateId part) { return is_done(part, below(task)); };
        if (!way.begun || way.left_out || std::ranges::all_of(way.parts, done)) continue;
        more = way.left_out = true;
      }
    for (const Timeline& timeline : timelines_)
      for (const StateId state : timeline.reached) {
        if (mark(state).left_out) continue;
        const bool never_ends = is_complex(state) && state != timeline.initial && !mark(state).done;
        if (!never_ends && unmet_need(state) == nullptr) continue;
        more = mark(state).left_out = true;
      }
    return more;
  }

  const model::Need* unmet_need(StateId state) const {
    const model::State& definition = ground_.definition(state);
    std::vector<Index> variables = ground_.at(state).state.objects;
    variables.resize(variables.size() + definition.free.size(), kNone);
    for (const model::Need& need : definition.needs) {
      const Timeline& timeline = timelines_[need.state.component];
      const auto fits = [&](StateId other) { return ground_.fits(other, need.state, variables); };
      if (std::ranges::none_of(timeline.reached, fits) && std::ranges::none_of(timeline.earlier, fits))
        return &need;
    }
    return nullptr;
  }

  // The first that is never met, of what is triggered and of the goals.
  std::optional<NeverReached> unmet() {
    explained_.clear();
    for (std::size_t cause = 0; cause < causes_; ++cause)
      if (!tasks_[cause].done) return NeverReached{kNone, reason_of(tasks_[cause])};
    for (const Index g : goal_order(*model_.problem)) {
      const StateId state = ground_.find(ground_of(model_.problem->goals[g].state, {}));
      if (!is_done(state, 0)) return NeverReached{g, reason_of(state, 0)};
    }
    return std::nullopt;
  }

  std::string only_comes_to(Index component) const {
    const auto& reached = timelines_[component].reached;
    std::string out;
    for (std::size_t i = 0; i < std::min(kNamed, reached.size()); ++i)
      out += (i == 0 ? "" : ", ") + ground_.text(reached[i]);
    if (reached.size() > kNamed) out += " and " + std::to_string(reached.size() - kNamed) + " more";
    return "that timeline comes to " + out + " alone";
  }

  std::string reason_of(const Task& task) {
    const std::string wanted = task.state == kNone ? "the plan" : ground_.text(task.state);
    std::string out;
    for (const Way& way : task.ways) {
      const Behaviour& behaviour = model_.behaviours[way.behaviour];
      const std::string asks = "behaviour '" + behaviour.name + "' for " + wanted + " asks for ";
      for (const model::Precondition& condition : behaviour.conditions)
        if (!fits(condition, way.objects))
          return asks + (condition.negated ? "not " : "") +
                 to_text(model_, ground_of(condition.state, way.objects)) + ", and " +
                 only_comes_to(condition.state.component);
      for (const StateId part : way.parts)
        if (out.empty() && !is_done(part, below(task))) out = reason_of(part, below(task));
    }
    if (out.empty()) out = "no behaviour achieves " + wanted + " with these objects";
    return out;
  }

  std::string reason_of(StateId state, ComponentSet above) {
    if (!explained_.emplace(state, above).second) return "";
    const auto task = task_of_.find({state, above});
    if (task != task_of_.end() && tasks_[task->second].known) return reason_of(tasks_[task->second]);
    if (const model::Need* need = is_complex(state) ? nullptr : unmet_need(state))
      return ground_.text(state) + " needs " +
             to_text(model_, need->state, scope_of(ground_.definition(state))) + ", and " +
             only_comes_to(need->state.component);
    for (const StateId before : graph(component(state)).states()) {
      if (!ground_.may_follow(before, state)) continue;
      for (const auto& [key, index] : task_of_) {
        if (key.first != before || tasks_[index].done || explained_.contains(key)) continue;
        if (const std::string out = reason_of(before, key.second); !out.empty()) return out;
      }
    }
    return "no transitions lead to " + ground_.text(state) + ", and " + only_comes_to(component(state));
  }

  static std::vector<model::Variable> scope_of(const model::State& state) {
    std::vector<model::Variable> out = state.parameters;
    out.insert(out.end(), state.free.begin(), state.free.end());
    return out;
  }

  std::size_t bytes() const {
    std::size_t out = ground_.bytes() + bindings_.bytes() + marks_.capacity() * sizeof(Mark) +
                      tasks_.size() * 200 + way_bytes_;
    for (const Timeline& timeline : timelines_)
      if (timeline.graph) out += timeline.graph->bytes();
    return out;
  }

  const model::Model& model_;
  std::size_t most_bytes_;
  const std::function<bool()>& cancelled_;
  Ground ground_;
  Bindings bindings_;
  Successors successors_;
  std::set<std::pair<Index, Index>> left_for_another_;  // states to rest in that a need may end
  std::vector<Timeline> timelines_;
  std::vector<Mark> marks_;
  std::vector<Task> tasks_;  // what is triggered first
  std::map<std::pair<StateId, ComponentSet>, std::size_t> task_of_;
  std::set<std::pair<Index, std::vector<Index>>> task_ways_;  // of the task whose ways are found
  std::size_t causes_ = 0;
  std::size_t steps_ = 0;
  std::size_t way_bytes_ = 0;
  std::set<std::pair<StateId, ComponentSet>> explained_;
};

}  // namespace

std::optional<NeverReached> never_reached(const model::Model& model, std::size_t most_bytes,
                                          const std::function<bool()>& cancelled) {
  return Relaxation(model, most_bytes, cancelled).run();
}

}  // namespace roci::planner::timeline_htn::search
