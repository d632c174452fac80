// The task network of a utility-driven mission as plain data (MEXEC, sections II.C and IV.A.1, R67–R71, R83, R87–R89):
// read from YAML or from its binary form, checked whole, and never changed afterwards; what is learned on the way are
// values of its parameters.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "core/temporal/duration.hpp"
#include "core/temporal/flexible_plan.hpp"
#include "core/temporal/rank_vector.hpp"
#include "core/temporal/timelines/definition.hpp"

namespace roci::planner::utility_htn::model {

using TaskIndex = std::uint32_t;
using ParameterIndex = std::uint32_t;

/// Describes a number that is not known for sure: a prior until it is measured on board or told by the ground (R116,
/// R118).
struct Parameter {
  std::string name;  ///< e.g. "excavate_s.site_0"
  double prior = 0;
  /// Bound the values that may be measured or told; others are refused.
  double lowest = -std::numeric_limits<double>::infinity();
  double highest = std::numeric_limits<double>::infinity();
  std::string source{};  ///< where the prior comes from, or why it was chosen
  /// Returns whether the value lies in the range; what is no number does not.
  bool permits(double value) const { return value >= lowest && value <= highest; }
  friend bool operator==(const Parameter&, const Parameter&) = default;
};

/// Holds a number of a task: constant + factor × parameter.
struct Amount {
  double constant = 0;
  std::optional<ParameterIndex> parameter{};
  double factor = 1;
  friend bool operator==(const Amount&, const Amount&) = default;
};

/// Holds timelines::Impact with an amount that may depend on a parameter.
struct Impact {
  temporal::timelines::Index timeline = 0;
  temporal::ImpactKind kind = temporal::ImpactKind::delta;
  temporal::ImpactWhen moment = temporal::ImpactWhen::at_start;
  Amount amount{};
  friend bool operator==(const Impact&, const Impact&) = default;
};

/// Says how urgently data must reach Earth (RSM-1, section II.B.2, R110; appendix A, Z18).
enum class Tier {
  critical,    ///< at once
  decisional,  ///< with the next downlink
  mandatory,   ///< before the mission ends
  residual,    ///< only with what is left over
};

/// Describes data that a task generates.
struct Product {
  std::string name;
  Tier tier = Tier::mandatory;
  Amount bytes{};
  temporal::RankVector utility{};  ///< counts when its last byte is received on Earth
  friend bool operator==(const Product&, const Product&) = default;
};

/// Says what the executive may do by itself (R68, R98, R99).
struct Control {
  temporal::Duration wait_timeout = temporal::no_bound;   ///< bounds the push after the planned start
  temporal::Duration answer_within = temporal::no_bound;  ///< bounds the time to a command's first answer
  std::uint32_t retries = 0;
  bool may_skip = false;  ///< skipped instead of failed when it cannot start in time
  std::vector<temporal::timelines::Constraint> skip_if{};  ///< all of them true at the start: skipped
  friend bool operator==(const Control&, const Control&) = default;
};

/// Edits the network when a task has failed (R69): instances of templates come, requests go.
struct Contingency {
  std::vector<TaskIndex> requests{};
  std::vector<TaskIndex> withdraws{};
  friend bool operator==(const Contingency&, const Contingency&) = default;
};

/// Describes one subtask of a decomposition: it follows the one before, between the two gaps from that one's end to its
/// start.
struct Subtask {
  TaskIndex task = 0;
  temporal::Duration shortest_gap{0};
  temporal::Duration longest_gap = temporal::no_bound;
  friend bool operator==(const Subtask&, const Subtask&) = default;
};

/// Describes one way to do a parent task (R87). It can be chosen when all of `when` hold at its first start: so the
/// phase of the mission on a timeline selects among them (figure 4).
struct Decomposition {
  std::string name;
  std::vector<temporal::timelines::Constraint> when{};
  std::vector<Subtask> subtasks;
  friend bool operator==(const Decomposition&, const Decomposition&) = default;
};

/// Says what a parameter is learned from when a task has ended (R116): what the task took, or a value that
/// was computed on board (R108).
enum class Measure { duration_s, energy, power, value };

/// Names a parameter that a task learns when it has ended, and from what.
struct Learns {
  Measure measure = Measure::duration_s;
  ParameterIndex parameter = 0;
  std::string result{};  ///< of a value: its name among the results of the task's commands
  friend bool operator==(const Learns&, const Learns&) = default;
};

/// Describes one task. With decompositions it is a parent and has no footprint of its own; without it is
/// primitive.
struct Task {
  std::string id;    ///< unique in the network, e.g. "collect_1_2"
  std::string name;  ///< for people, e.g. "Collect Sample(1, 2)"
  std::int32_t priority = 0;
  bool is_template = false;  ///< not asked for; subtasks and contingencies use it
  std::uint32_t batch = 0;   ///< batches are scheduled in this order, each frozen for the next (R97)
  bool fixed = false;        ///< it starts at `preferred_start` or not at all, as uplinks do
  std::vector<temporal::PlanCommand> commands{};    ///< none: NO-OP; several: a sequence
  std::optional<temporal::PlanCommand> response{};  ///< sent by the executive at once when it fails (R70)
  std::optional<Contingency> contingency{};
  Amount duration{};                                        ///< in seconds
  temporal::Duration preferred_start = temporal::no_bound;  ///< mission time; no_bound: none
  temporal::Time opens{0};                                  ///< earliest start
  temporal::Time closes = temporal::no_bound;               ///< latest end
  std::vector<Impact> impacts{};
  std::vector<temporal::timelines::Constraint> constraints{};
  Control control{};
  std::vector<Amount> utility{};  ///< by rank, the highest first; expected, until the Assessor says otherwise
  std::vector<Product> products{};
  bool downlinks = false;  ///< it sends data: what and how long is the Downlink Manager's to say
  std::vector<Learns> learns{};
  std::vector<Decomposition> decompositions{};
  bool primitive() const { return decompositions.empty(); }
  friend bool operator==(const Task&, const Task&) = default;
};

/// Describes a target that can be sampled, and its line on the subway map (figure 3, R112).
struct Target {
  TaskIndex task = 0;                        ///< the parent task that samples it
  temporal::timelines::Index signature = 0;  ///< state timeline: unknown, negative, positive
  Amount visual{};                           ///< weight by visual inspection, in [0, 1]
  friend bool operator==(const Target&, const Target&) = default;
};

/// Describes a site of the subway map with its targets.
struct Site {
  std::string name;
  Amount value{};  ///< estimated by vision, in [0, 1]
  std::vector<Target> targets;
  friend bool operator==(const Site&, const Site&) = default;
};

/// Holds the rule by which samples follow each other; without sites there is none.
struct SubwayMap {
  std::uint32_t most_samples = 3;  ///< at one site
  std::uint32_t rank = 0;          ///< of the utility, at which the map is enforced (R114)
  std::vector<Site> sites{};
  friend bool operator==(const SubwayMap&, const SubwayMap&) = default;
};

/// Holds the timing windows of the planning cycle (R77–R81).
struct CycleWindows {
  temporal::Duration process_interval{0};
  temporal::Duration worst_cycle{0};    ///< as measured; the interval is longer
  temporal::Duration commit_window{0};  ///< at least the interval
  temporal::Duration scheduling_window = temporal::no_bound;
  temporal::Time plan_end = temporal::no_bound;
  friend bool operator==(const CycleWindows&, const CycleWindows&) = default;
};

/// Holds a whole network.
struct Network {
  std::string name;
  std::uint64_t version = 0;
  std::vector<std::string> ranks;  ///< names, the highest first (R113)
  std::vector<Parameter> parameters;
  std::vector<temporal::timelines::Definition> timelines;
  temporal::timelines::Index budget = 0;  ///< the timeline that is spent: the battery
  std::vector<Task> tasks;
  std::vector<std::string> batches;  ///< names, the first is scheduled first
  SubwayMap subway{};
  CycleWindows cycle{};
  std::uint64_t exploration_bound = 10'000;  ///< entries that the search takes from its queue in one batch
  friend bool operator==(const Network&, const Network&) = default;
};

/// Holds the current values of all parameters, by ParameterIndex; those of a network that has learned nothing
/// are its priors.
using Values = std::vector<double>;
Values priors(const Network& network);

double evaluate(const Amount& amount, const Values& values);
/// Returns how long a primitive task takes, in seconds; never below 0.
double duration_s(const Task& task, const Values& values);
/// Returns what timelines see of a primitive task.
temporal::timelines::Footprint footprint(const Task& task, const Values& values);
/// Returns what a primitive task takes from the budget, in its unit: deltas and rates over the duration (R87).
double cost(const Network& network, const Task& task, const Values& values);
/// Returns whether the impact sets a state that somebody reports: whether it has come about is seen by that.
bool sets_reported_state(const Network& network, const Impact& impact);
/// Returns what the task draws from the budget per second while it runs; negative: it charges it.
double draw(const Network& network, const Task& task, const Values& values);
temporal::RankVector utility(const Task& task, const Values& values);

}  // namespace roci::planner::utility_htn::model
