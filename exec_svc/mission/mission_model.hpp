// A mission as the reactor sees it has metadata that say which states are inactive and what goals mean, and
// for an engine that reads PDDL how observations become facts and actions commands (R43-R46). It is read from
// mission.yaml; code never names a mission.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "core/temporal/flexible_plan.hpp"
#include "exec_svc/executive/contingency.hpp"
#include "exec_svc/executive/executive.hpp"
#include "exec_svc/mission/autonomy_level.hpp"
#include "exec_svc/mission/executive_role.hpp"

namespace roci::pddl {
struct Domain;
}
namespace roci::mission {
class Findings;
}

namespace roci::exec::mission {

/// Describes a state of a component. `facts` may hold ?1, ?2, … for the observed state's arguments and * for
/// a family's object.
struct StateModel {
  std::string name;
  bool active = false;
  std::vector<std::string> facts;
};

/// What a component counts as when services are gone that it cannot do without.
struct LossModel {
  std::vector<std::string> without;  ///< the services; one of them is enough
  temporal::Duration after{0};       ///< for which a service has been away, from its loss on
  temporal::State as;                ///< one of the component's inactive states
};

/// A subsystem; planning starts only when it is in an inactive state, reached by its fallback command (R43,
/// R44).
struct Component {
  std::string robot;  ///< robot that has it; empty: the owner's only one
  std::string name;
  std::string timeline;
  std::string owner;
  std::string fallback;
  std::vector<StateModel> states;
  std::optional<LossModel> lost{};  ///< none: its services are waited for, however long they are away
};

/// Describes one timeline per object, named `prefix` + the object's name. Its states persist and are all
/// inactive.
struct TimelineFamily {
  std::string prefix;
  std::vector<StateModel> states;
};

/// Says where a numeric fluent of the PDDL problem gets its value from.
struct FluentSource {
  std::string fluent;                   ///< "(battery)"
  std::optional<std::string> timeline;  ///< its newest observed value counts, or else
  double value = 0;
  std::optional<double> last;  ///< replaces `value` before a hard goal is given up
};

/// Describes a fact and a truth-valued timeline that change by the clock, as predicted.
struct WindowModel {
  std::string fact;                                             ///< empty without a PDDL domain
  std::string timeline;                                         ///< says whether it is open now
  std::vector<std::pair<temporal::Time, temporal::Time>> open;  ///< in mission time, ascending, disjoint
};

/// Says where a property of an object gets its value from.
struct PropertySource {
  std::string name;
  std::string text;                     ///< a number, or {argument} in a goal kind
  std::optional<std::string> timeline;  ///< its newest observed value replaces the text
};

/// Describes an object of the mission or of a goal kind, with its properties.
struct ObjectModel {
  std::string name;
  std::string type;      ///< may be empty without a PDDL domain
  bool dynamic = false;  ///< declared only while an observed state names it
  std::vector<PropertySource> properties;
};

/// Says what a goal's argument is: a number, a word, the id of another goal, or an object of the mission.
enum class ArgumentKind { number, text, goal, object };

/// Describes a kind of goals by templates with {id}, {robot} (whom the goal is for) and {argument}.
struct GoalKind {
  std::string name;
  std::string help;
  std::map<std::string, ArgumentKind> arguments;
  /// Holds the type in the domain of the arguments that are objects.
  std::map<std::string, std::string> object_types;
  std::vector<ObjectModel> objects;
  std::vector<std::string> facts;
  std::vector<std::string> facts_while_open;  ///< hold only until the goal has ended
  /// Gives for a timeline the facts that hold until it is observed.
  std::vector<std::pair<std::string, std::vector<std::string>>> unobserved;
  std::string window_fact;  ///< empty: the kind has no window
  /// Says when a goal is achieved; if it is empty, when all of `goal` are observed.
  temporal::Condition achieved;
  /// Lists the conditions of the PDDL goal, mostly facts. Where the kind names none, they are derived from `achieved`.
  std::vector<std::string> goal;
  /// Says whether some of `goal` is no directly observed fact, but derived, negated, an alternative or about
  /// numbers.
  bool formula = false;
};

/// Says which command an action of the plan becomes. Argument values may hold ?1, ?2.x (a property of that
/// object).
struct ActionBinding {
  std::string owner;
  std::string robot;  ///< robot of the component
  std::string component;
  std::string command;
  std::vector<std::pair<std::string, std::string>> arguments;
  temporal::LatenessPolicy lateness = temporal::LatenessPolicy::replan;
  std::uint32_t retries = 0;
  temporal::Duration wait_timeout = temporal::no_bound;
  temporal::Duration retry_within = temporal::no_bound;  ///< counted from its start
  std::string contingency;                               ///< empty: none
};

/// Says what is done when a plan breaks or a step fails (R102). The plans are the same under each strategy.
enum class RecoveryStrategy {
  cascade,     ///< push, retry, contingency, then replan, drop goals, and at last the ground
  as_planned,  ///< "static": nothing; the open goals fail
  ground,      ///< the robot is made safe and the ground asked at once
  flexible,    ///< "fe": push, retry, contingency, then the ground
  replan,      ///< replan at once, drop goals, then the ground
};

/// Says what goes on while the planner works; in mission.yaml: `paused`, `situated`, `continuous`.
enum class Replanning {
  stop_and_replan,  ///< nothing: what runs is cancelled, all components fall back first (R43, R44)
  background,  ///< what runs: it is planned from the state that it will leave, and the plans change there
  continuous,  ///< everything: the engine plans all the time and sends versions of its plan (R66)
};

/// Says which engine plans for the mission, and what a call may take.
struct PlannerSettings {
  std::string engine = "temporal_pddl";
  std::string service;     ///< service that hosts it; empty: the mission's planner_svc that serves the robot
  std::uint64_t work = 0;  ///< evaluations; 0: no bound
  std::uint32_t memory_mb = 0;
  temporal::Duration wall{0};
  temporal::Duration allowance = temporal::seconds(5);  ///< a plan's origin lies this long after the request
  /// Bounds the mission time until a call counts as lost.
  temporal::Duration reply_timeout = temporal::seconds(120);
};

/// Says how the reactor and the executive act: time limits, retries, recovery and what is kept.
struct ReactorSettings {
  temporal::Duration ack_timeout = temporal::seconds(5);
  temporal::Duration fallback_timeout = temporal::seconds(60);  ///< time for components to become inactive
  /// Delays when an owner that died counts as lost, and its commands as failed (0: at once).
  temporal::Duration owner_return{0};
  std::uint32_t replan_limit = 50;
  std::uint32_t call_retries = 5;  ///< bounds the planner calls that fail for want of a service
  /// Bounds the failed commands of one component in a row; then their goals are given up.
  std::uint32_t failure_limit = 5;
  temporal::Duration failure_pause = temporal::seconds(30);  ///< after the second failure; doubles with each
  temporal::Duration failure_pause_max = temporal::seconds(600);  ///< bounds that pause
  /// Bounds the planner calls that find the fewest hard goals to give up when not even those all fit; 0: the
  /// newest goes.
  std::uint32_t hard_goal_trials = 0;
  bool keep_inputs = true;  ///< the journal keeps all inputs; false: those since the last anchor
  /// Where inputs are not kept, counts the newest traces, events and decisions that are kept beside all since the last
  /// anchor.
  std::uint32_t kept_records = 20'000;
  RecoveryStrategy recovery = RecoveryStrategy::cascade;
  executive::StartPolicy start = executive::StartPolicy::earliest;
  Replanning replanning = Replanning::stop_and_replan;
  AutonomyLevel autonomy = AutonomyLevel::e4;              ///< with which the mission begins
  temporal::Duration standby_term = temporal::seconds(2);  ///< wall time; see standby/lease.hpp
  /// Not of the mission, but of the scenario's links (executive::ExecutiveSettings).
  std::map<std::string, temporal::Duration> round_trips{};

  /// Returns whether the engine sends versions of its plan all the time, and is never called.
  bool plans_continuously() const { return replanning == Replanning::continuous; }
};

/// Says what the ground may change in flight by an order.
struct GroundModel {
  std::vector<std::string> values;   ///< timelines that the ground owns
  std::vector<std::string> uploads;  ///< places of the mission file, e.g. "contingencies.wipe-lens"
};

/// Holds all that mission.yaml says to one of the mission's executives.
struct MissionModel {
  std::string name;
  ExecutiveRole role;
  std::string model_text;   ///< the PDDL domain, or a model in the engine's own language; may be empty then
  std::string domain_name;  ///< empty: the engine reads no PDDL
  std::shared_ptr<const pddl::Domain> domain;  ///< as read; null where the engine reads no PDDL
  std::vector<ObjectModel> objects;
  std::vector<std::string> facts;  ///< hold in every problem and never change
  std::vector<Component> components;
  std::vector<TimelineFamily> families;
  std::vector<FluentSource> fluents;
  std::vector<WindowModel> windows;
  std::map<std::string, ActionBinding> actions;
  std::map<std::string, executive::Contingency> contingencies;
  std::map<std::string, GoalKind> goal_kinds;
  PlannerSettings planner;
  ReactorSettings executive;
  GroundModel ground;

  bool has_domain() const { return !domain_name.empty(); }
};

/// Returns the names of the objects of a type of the domain that every problem has, and of its constants.
std::vector<std::string> objects_of_type(const MissionModel& mission, const std::string& type);

/// Returns the services that execute the commands of the mission's components.
std::set<std::string> owners_of(const MissionModel& mission);

/// Reads a mission file (or the mission.yaml of a folder) for one of its executives. In names of timelines
/// {robot} is the executive's robot; components of other robots are left out. Throws roci::mission::FileError
/// naming file, line, column and remedy; with `findings` it notes all faults there, and what is returned lacks the
/// parts that could not be read.
MissionModel read_mission(const std::filesystem::path& folder_or_file, const ExecutiveRole& role = {},
                          roci::mission::Findings* findings = nullptr);

}  // namespace roci::exec::mission
