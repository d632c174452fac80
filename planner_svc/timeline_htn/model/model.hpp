// What the hierarchical timeline engine plans from, as data (QuijoteExpress, section 4.2; R134–R140): the domain D
// (components, their states and relations), the behaviours B (how complex states come about) and the problem P (initial
// states and goals). Plain values; indices refer to the lists of `Model`.
// docs/timeline-format.md says what each word means.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/temporal/condition.hpp"
#include "core/temporal/duration.hpp"
#include "core/temporal/flexible_plan.hpp"

namespace roci::planner::timeline_htn::model {

using Index = std::uint32_t;

/// Names an object of a type.
struct Object {
  std::string name;
  Index type = 0;
  friend bool operator==(const Object&, const Object&) = default;
};

/// Names a variable with the type of the objects that it stands for.
struct Variable {
  std::string name;
  Index type = 0;
  friend bool operator==(const Variable&, const Variable&) = default;
};

/// Names a variable of the scope in which it stands, by number, or an object.
struct Term {
  Index index = 0;
  bool object = false;
  friend bool operator==(const Term&, const Term&) = default;
};

/// Holds a table over objects: rows of a relation, or the numbers of a function. What has no row does not
/// hold, or has no number.
struct Relation {
  std::string name;
  std::vector<Index> types;
  std::vector<std::vector<Index>> rows;  ///< sorted, each once
  /// Names, where a relation is observed, its timeline and value: the relation holds of a and b, too, where
  /// the timeline "TIMELINE.a.b" has this value. Else both are empty.
  std::string timeline{};
  std::string value{};
  friend bool operator==(const Relation&, const Relation&) = default;
};
/// Says that a service gives the numbers of a table: it is asked before each search, exactly (R35, R36).
struct AskedNumbers {
  std::string module;
  std::string function;
  std::optional<Index> rows_of;  ///< a relation, of whose rows alone; nothing: of all objects of the types
  std::string place;             ///< where it says so: "file:line:column"
  bool given = false;            ///< whether the numbers have come
  friend bool operator==(const AskedNumbers&, const AskedNumbers&) = default;
};

/// Holds the numbers of a function over objects.
struct NumberTable {
  std::string name;
  std::vector<Index> types;
  std::map<std::vector<Index>, double> rows;  ///< all finite
  std::optional<AskedNumbers> asked{};        ///< then its rows come with the call to plan
  friend bool operator==(const NumberTable&, const NumberTable&) = default;
};

/// Names the operators of expressions.
enum class Operator { constant, table, add, subtract, multiply, divide };
/// Holds one node of an expression.
struct ExpressionNode {
  Operator op = Operator::constant;
  double constant = 0;
  Index table = 0;
  std::vector<Term> terms;  ///< of the table
  friend bool operator==(const ExpressionNode&, const ExpressionNode&) = default;
};
/// Holds a number made of constants and tables, in postfix order.
using Expression = std::vector<ExpressionNode>;

/// Names the comparisons of numbers.
enum class Comparison { lt, le, eq, ne, ge, gt };
/// Holds a static test: a relation that holds or does not, two equal or unequal terms, or two numbers that are
/// compared.
struct Test {
  enum class Kind { relation, terms, numbers } kind = Kind::relation;
  bool negated = false;  ///< of a relation
  Index relation = 0;
  std::vector<Term> terms;                 ///< of the relation, or the two that are compared
  Comparison comparison = Comparison::eq;  ///< of terms (eq, ne) or numbers
  Expression left, right;
  friend bool operator==(const Test&, const Test&) = default;
};

/// Names a state of a component with terms in place of its parameters.
struct Pattern {
  Index component = 0;
  Index state = 0;
  std::vector<Term> terms;
  friend bool operator==(const Pattern&, const Pattern&) = default;
};

/// Says on which layer of the hierarchy a component stands (R135).
enum class Layer { abstract, primitive };

/// Says how a state comes about.
enum class StateKind {
  complex,  ///< brought about by a behaviour, whose subgoals are its parts
  simple,   ///< lasts as its duration says; may have a command
  error,    ///< is never planned for; a plan may begin with it
  resting,  ///< "default": lasts as long as nothing else is asked of the component
};

/// Describes the value of a timeline by which a state is seen. Terms are the state's parameters.
struct Observed {
  std::string timeline;
  std::string word;         ///< name of the state, "true", "false" or a number
  std::vector<Term> terms;  ///< arguments
  friend bool operator==(const Observed&, const Observed&) = default;
};

/// Describes an argument of a command: words, with terms for the places that parameters fill.
struct Argument {
  std::string name;
  std::string text;          ///< without a term: the value as it is
  std::optional<Term> term;  ///< the name of what stands for it
  std::string property;      ///< of that object, which the executive knows; empty: the object's name itself
  friend bool operator==(const Argument&, const Argument&) = default;
};

/// Describes the command of a state, as PlanCommand.
struct Command {
  std::string owner;
  std::string robot;
  std::string subsystem;
  std::string name;
  std::vector<Argument> arguments;
  temporal::Duration answer_within = temporal::no_bound;
  friend bool operator==(const Command&, const Command&) = default;
};

/// Says where the state of another component stands in time to the one that needs it.
enum class NeedKind {
  during,    ///< the other lasts all the while
  at_start,  ///< the other holds at the start
  met_by,    ///< the other ends just at the start
};

/// Describes a dependency (R136): what a state needs of another component. Terms are parameters of the state,
/// or free: some state that fits.
struct Need {
  NeedKind kind = NeedKind::during;
  Pattern state;
  friend bool operator==(const Need&, const Need&) = default;
};

/// Describes a state of a component, with what it needs and how it is seen.
struct State {
  std::string name;
  StateKind kind = StateKind::simple;
  std::vector<Variable> parameters;
  std::vector<Test> where;  ///< of its parameters; else there is no such state
  Expression shortest;      ///< seconds; empty: 0
  Expression longest;       ///< seconds; empty: no bound
  std::optional<Command> command;
  std::vector<Variable> free;  ///< variables of its needs beside the parameters, numbered after them
  std::vector<Need> needs;
  std::optional<Observed> observed;
  std::string contingency;  ///< of PlanActivity
  std::uint32_t retries = 0;
  friend bool operator==(const State&, const State&) = default;
};

/// Says which state may follow at once. Equal variables in both are equal objects.
struct Transition {
  Index from = 0;
  std::vector<Term> from_terms;
  Index to = 0;
  std::vector<Term> to_terms;
  std::vector<Variable> variables;
  friend bool operator==(const Transition&, const Transition&) = default;
};

/// Describes a component, which has one timeline.
struct Component {
  std::string name;
  Layer layer = Layer::primitive;
  std::string robot;
  std::vector<State> states;
  std::vector<Transition> transitions;
  friend bool operator==(const Component&, const Component&) = default;
};

/// Says what has to come about for a behaviour.
struct Subgoal {
  std::string name;
  Pattern state;
  std::string contingency;  ///< in place of the state's own; empty: that one
  friend bool operator==(const Subgoal&, const Subgoal&) = default;
};

/// Names the start or end of a subgoal, or of the behaviour itself.
struct Point {
  std::optional<Index> subgoal;  ///< nothing: the behaviour
  bool end = false;
  friend bool operator==(const Point&, const Point&) = default;
};

/// Requires lower <= to - from <= upper, in seconds.
struct SubgoalConstraint {
  Point from, to;
  Expression lower;  ///< empty: none
  Expression upper;  ///< empty: none
  friend bool operator==(const SubgoalConstraint&, const SubgoalConstraint&) = default;
};

/// Describes one of the ways in which a decision may go.
struct Choice {
  std::string name;
  std::vector<Index> subgoals;
  temporal::Condition rule;  ///< of observed timelines; empty: always true
  bool instead = false;      ///< brings about the same as the first one, so that the plan goes on behind it
  friend bool operator==(const Choice&, const Choice&) = default;
};

/// Describes a decision that the plan leaves open (R131): a choice among groups of subgoals, of which the plan
/// reckons with the first; the value of a variable in the arguments of commands; or what else a variable might stand
/// for, of which the plan reckons with one object.
struct Decision {
  std::string name;
  temporal::ResolverKind resolver_kind = temporal::ResolverKind::ground;
  std::string resolver;  ///< service or issuer; empty: whoever is of the kind
  Point before;
  std::vector<Choice> choices;
  std::optional<Index> variable;
  bool over = false;  ///< each object of the variable is a choice: what is planned behind it depends on it
  /// Are, of a decision over a variable, what is done of each choice before the plan is refined.
  std::vector<Index> subgoals;

  /// Returns whether some answer leaves undone what is planned behind the decision.
  bool may_end_plan() const {
    for (std::size_t c = 1; c < choices.size(); ++c)
      if (!choices[c].instead) return true;
    return over;
  }
  /// Returns whether an answer binds arguments.
  bool binds() const { return variable && !over; }
  friend bool operator==(const Decision&, const Decision&) = default;
};

/// Holds a condition of a behaviour at its start.
struct Precondition {
  Pattern state;
  bool negated = false;
  friend bool operator==(const Precondition&, const Precondition&) = default;
};

/// Describes a network of subgoals (R137, section 4.2.2).
struct Behaviour {
  std::string name;
  std::optional<Pattern> achieves;  ///< a complex state; nothing: it has triggers alone
  std::vector<Pattern> triggers;    ///< states in which a plan may not stay: it begins with the behaviour
  bool on_goal_change = false;      ///< likewise where the problem says that its goals have changed
  std::int32_t priority = 0;        ///< the higher is tried first
  std::vector<Variable> variables;  ///< those of `achieves` and of the triggers first
  std::vector<Test> where;
  std::vector<Precondition> conditions;
  std::vector<Subgoal> subgoals;
  std::vector<SubgoalConstraint> constraints;
  std::vector<Decision> decisions;
  friend bool operator==(const Behaviour&, const Behaviour&) = default;
};

/// Describes a goal: a state that is to come about within a window.
struct Goal {
  std::string id;               ///< "issuer/id", or a name of the problem's own
  Pattern state;                ///< objects alone
  temporal::Duration opens{0};  ///< earliest start of the state; counts from the origin
  temporal::Duration closes = temporal::no_bound;
  std::vector<Index> after;       ///< goals that end first
  temporal::Duration release{0};  ///< earliest start of each activity that serves it; counts from the origin
  friend bool operator==(const Goal&, const Goal&) = default;
};

/// Holds a state that a component is known to come to, whatever the plan: of objects alone.
struct PredictedState {
  temporal::Duration at{0};  ///< counts from the origin
  Pattern state;
  friend bool operator==(const PredictedState&, const PredictedState&) = default;
};

/// Describes P: where every component begins, what is known to come, and what is asked for.
struct Problem {
  temporal::Duration horizon = temporal::no_bound;  ///< H; counts from the origin
  std::vector<std::optional<Pattern>> initial;      ///< by component; objects alone
  std::vector<Goal> goals;
  bool goals_changed = false;
  /// Has nothing for a component whose states the plan brings about; another one stays as it begins until the first of
  /// these, and no plan changes it. They stand in order of time. Components behind the last one have nothing.
  std::vector<std::optional<std::vector<PredictedState>>> predicted{};
  friend bool operator==(const Problem&, const Problem&) = default;
};

/// Holds domain and behaviours, with a problem if one was read.
struct Model {
  std::string name;
  std::vector<std::string> types;
  std::vector<Object> objects;
  std::vector<Relation> relations;
  std::vector<NumberTable> numbers;
  std::vector<Component> components;
  std::vector<Behaviour> behaviours;
  std::optional<Problem> problem;  ///< nothing: only D and B were read
  friend bool operator==(const Model&, const Model&) = default;
};

/// Holds a state without variables: what a timeline holds.
struct GroundState {
  Index component = 0;
  Index state = 0;
  std::vector<Index> objects;
  friend bool operator==(const GroundState&, const GroundState&) = default;
  friend auto operator<=>(const GroundState&, const GroundState&) = default;
};

/// Returns whether the problem of the model, if it has one, tells all that the component will do.
bool is_predicted(const Model& model, Index component);

/// Prints "component.state(a, b)".
std::string to_text(const Model& model, const GroundState& state);
/// Prints the same with the names of variables, which are those of `scope`.
std::string to_text(const Model& model, const Pattern& pattern, const std::vector<Variable>& scope);
/// Returns the value that a timeline of the plan holds in this state.
temporal::Value value_of(const Model& model, const GroundState& state);
/// Returns the words of the layer and of the kind, as they are written: "abstract", "default".
const char* to_text(Layer layer);
const char* to_text(StateKind kind);

}  // namespace roci::planner::timeline_htn::model
