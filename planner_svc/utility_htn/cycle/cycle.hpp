// The planning cycle (MEXEC, section IV.A.3, R77–R82): commits, consolidates, schedules, repairs and optimizes, in this
// order, on a network whose timelines are kept in step with what is observed and executed.
#pragma once

#include <cstdint>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"
#include "planner_svc/utility_htn/assessor/assessor.hpp"
#include "planner_svc/utility_htn/cycle/observations.hpp"
#include "planner_svc/utility_htn/cycle/placement.hpp"
#include "planner_svc/utility_htn/cycle/sessions.hpp"
#include "planner_svc/utility_htn/delivery/delivery.hpp"
#include "planner_svc/utility_htn/search/search.hpp"

namespace roci::planner::utility_htn::cycle {

/// Names the parts of a cycle in their order (R77).
enum class Activity { commit, consolidate, schedule, repair, optimize };

/// Returns the part's name, as above.
const char* to_string(Activity part);

/// Says how plans are looked for.
enum class Search {
  once,     ///< to the network's bound on exploration (R92–R97)
  anytime,  ///< in passes that grow to that bound; says how much more utility there may be at most
  robust,   ///< judged by the worst of more, less and predicted energy
};

/// Says what a mission may choose (R82, R102).
struct Settings {
  bool repairs = true;
  bool optimizes = true;
  bool downlinks = true;        ///< data without a downlink are not generated (R127); otherwise all get home
  bool schedules_again = true;  ///< also after the first time; otherwise the first plan is all there is
  Search search = Search::once;
  /// Says by which share of a timeline's first value an observation must differ from what was foreseen before
  /// the cycle optimizes anew.
  double noticeable = 0.005;
  /// Bounds how often a request may fail before it is withdrawn.
  std::uint32_t most_failures = 3;
};

/// Tells what a cycle did.
struct Report {
  std::vector<Activity> done;  ///< in their order; those that had nothing to do are not named
  std::uint64_t explored = 0;  ///< entries that searches took from their queues
  bool changed = false;        ///< the placements are others than before
  /// Say what was dropped or withdrawn, and what is planned no longer, and why, in words.
  std::vector<std::string> notes;
};

/// Holds what outlives the process: with it and the blocks that are executed a cycle goes on as before.
struct Past {
  std::set<model::TaskIndex> done{};  ///< requests that need not come again
  /// Lists requests of the network that nobody asks for any more, as what failed too often.
  std::set<model::TaskIndex> withdrawn{};
  /// Lists templates that contingencies have requested (R69) and that are not done.
  std::set<model::TaskIndex> contingent{};
  /// Counts how often each request has failed since somebody asked for it.
  std::map<model::TaskIndex, std::uint32_t> failures{};
  model::Values values{};          ///< as learned
  std::vector<double> internal{};  ///< by timeline: values of those that nobody reports
  friend bool operator==(const Past&, const Past&) = default;
};

/// Holds plan and timelines. Between cycles it takes in observations and what became of tasks;
/// only run() changes the plan.
class Cycle {
 public:
  /// Plans a network that was checked. All arguments must outlive this object.
  Cycle(const model::Network& network, const flattening::Chains& chains, const assessor::Assessor& assessor,
        const search::Scheduler& scheduler, temporal::Time origin, Settings settings = {});

  void observe(temporal::timelines::Index timeline, temporal::Time sampled, double value);
  /// Takes the times at which a task really began and ended (R76).
  void begun(TaskId task, temporal::Time at);
  /// Takes in that the executive tries a running task again by itself (R99): it will take its whole duration once
  /// more.
  void tried_again(TaskId task, temporal::Time at);
  /// Takes in that a task which is not known to be over has generated the product of that name, which it promises no
  /// longer (R115).
  void generated(TaskId task, const std::string& product);
  void ended(TaskId task, temporal::Time at, bool succeeded, const std::string& cause = {});
  /// Asks for a template, or for something that was withdrawn; forgets its failures.
  void request(model::TaskIndex task);
  /// Takes in that somebody who asked for a task before another network came still does: what is done, or was given
  /// up, stays so.
  void still_requested(model::TaskIndex task);
  /// Lets a request go; what of it is committed stands.
  void withdraw(model::TaskIndex task);
  /// Replaces a parameter's value (R116, R118). Returns why not, if it is out of range.
  std::string set_value(model::ParameterIndex parameter, double value);
  /// Assesses data that exist, and plans no data without a downlink (R115, R127). `delivery` must outlive this
  /// object.
  void deliver_by(delivery::Delivery& delivery) { delivery_ = &delivery; }
  /// Lets the next cycle look for a better plan, whatever it knows.
  void doubt() { to_optimize_ = true; }
  /// Takes in that the executive has no plan any more: what ran has failed, what was committed is only planned.
  void nothing_runs(temporal::Time now);
  /// Goes on where another process stood at `since`; what became of the blocks after that is told next.
  void resume(const Past& past, std::vector<Block> blocks, std::uint32_t last_block, temporal::Time since);

  /// Numbers blocks beyond this one from now on, since another process may have used the numbers up to it.
  void number_beyond(std::uint32_t block) { last_block_ = std::max(last_block_, block); }

  Report run(temporal::Time now);

  const std::vector<Block>& blocks() const { return blocks_; }
  const Past& past() const { return past_; }
  const temporal::timelines::Timelines& timelines() const { return timelines_; }
  std::uint32_t last_block() const { return last_block_; }
  /// Returns what all that is placed will generate and send, as planned or as it turned out so far.
  search::PlannedData data() const;
  /// Returns the requests that wait for a place, in the order of the network.
  std::vector<model::TaskIndex> waiting() const;
  /// Returns the requests, in the order of the network, that are done, failed for good, withdrawn, or out of reach
  /// (flattening/reach.hpp): no plan holds them until something changes.
  std::vector<model::TaskIndex> closed(temporal::Time now) const;

 private:
  Block* block(std::uint32_t number);
  Link* link(TaskId task);
  void doom(TaskId failed);
  void believe_reports(temporal::Time now);
  bool commit(temporal::Time now);
  bool follow(temporal::Time now);
  temporal::Time expected(temporal::Time due, temporal::Time now) const;
  void await_start(Block& of, std::size_t index, temporal::Time now);
  temporal::Time set_before(const Link& waiting) const;
  bool consolidate(temporal::Time now);
  bool schedule(temporal::Time now, Report& report);
  bool repair(temporal::Time now, Report& report);
  bool optimize(temporal::Time now, Report& report);
  bool contributes(const Block& one, const temporal::timelines::Conflict& conflict) const;
  Block* culprit(const temporal::timelines::Conflict& conflict);
  bool out_of_order(const Block& one) const;
  void drop(const Block& waiting, const std::string& why, Report& report);
  bool keep_rules(temporal::Time now, Report& report);
  bool make_room(std::uint32_t number, temporal::Time from, Report& report);
  bool keep_order(temporal::Time now, Report& report);
  void push(Block& late, temporal::Time from);
  bool place_rests(std::uint32_t first, temporal::Time from);
  bool shift(Block& late, temporal::Time from);
  void lift(const Block& late);
  bool lower(Block& late, temporal::Time from);
  void last_anew(Block& begun) const;
  void take_out(const Block& gone);
  void put_in(const Block& placed);
  void abandon(Block& begun, const std::string& why, Report& report);
  void forget_over(Report& report);
  void tell_losses(temporal::Time now, Report& report);
  void edit_network(model::TaskIndex task);
  struct Found {
    search::Plan plan;
    bool better = true;  // than the plan that was held against it
  };
  search::Problem problem_for(temporal::Time now, const std::set<model::TaskIndex>& candidates,
                              std::span<const double> newest);
  search::Outcome search_in_passes(const search::Problem& problem, Report& report) const;
  Found plan_for(temporal::Time now, const std::set<model::TaskIndex>& candidates, Report& report,
                 const search::Plan* known = nullptr);
  void adopt(const search::Plan& plan);
  std::set<model::TaskIndex> candidates(temporal::Time now) const;
  void slide_window(temporal::Time now);
  std::vector<const Block*> by_start() const;
  search::Plan planned(temporal::Time now) const;
  temporal::RankVector predicted(std::uint32_t chain, std::span<const double> newest,
                                 std::span<const std::uint32_t> before,
                                 std::span<const model::TaskIndex> closed) const;
  std::vector<model::TaskIndex> closed_but(std::set<model::TaskIndex> open, temporal::Time now) const;
  void give_up(model::TaskIndex task);
  bool failed_too_often(model::TaskIndex task) const;
  temporal::timelines::Footprint footprint(const Block& block, std::size_t link) const;
  temporal::Duration duration(model::TaskIndex task) const;
  temporal::Duration length(const Block& block, std::size_t link) const;
  void note_made(const model::Task& by, temporal::ImpactWhen when, temporal::Time at);
  void fit_downlinks(temporal::Time now);
  temporal::Time room_until(const Link& of, temporal::Time wanted) const;
  bool lasts_later(const Block& of, std::size_t link, temporal::Duration takes, temporal::Time now);
  struct Placement {
    temporal::Time start{0};
    temporal::Duration length{0};
  };
  std::optional<Placement> soonest(const Block& of, std::size_t link, temporal::timelines::Footprint seen,
                                   temporal::timelines::Interval starts) const;
  std::vector<search::PlannedDownlink> others_begun(TaskId but, bool at_least) const;
  std::optional<temporal::Time> overdraws(const Block& one, const std::set<std::uint32_t>& sols) const;
  bool defer(std::uint32_t number, temporal::Time from);
  bool make_way(const std::set<std::uint32_t>& sols, std::set<std::uint32_t>& tried, temporal::Time from,
                Report& report);
  bool keep_limits(temporal::Time now, Report& report);
  void settle(temporal::Time now, Report& report);
  double budget() const;
  bool end_with_budget(temporal::Time now, Report& report);
  std::vector<double> values_now(temporal::Time now) const;

  const model::Network& network_;
  const flattening::Chains& chains_;
  const assessor::Assessor& assessor_;
  const search::Scheduler& scheduler_;
  delivery::Delivery* delivery_ = nullptr;  // none: all data get home, and none exist
  Settings settings_;
  temporal::timelines::Timelines timelines_;
  Past past_;
  std::set<model::TaskIndex> requested_;
  std::vector<Block> blocks_;  // by number
  Sessions sessions_;
  temporal::Time plan_end_ =
      temporal::no_bound;  // of the network, or before it where the budget does not last
  std::uint32_t last_block_ = 0;
  std::map<model::TaskIndex, std::uint32_t>
      planned_;                     // after the newest run: requests not begun, and their chains
  search::Outcome searched_;        // how the newest search of this run ended, without its plan
  std::vector<std::string> notes_;  // since the cycle before
  bool to_schedule_ = true;         // something waits that was not tried in this situation
  temporal::Time window_end_ = temporal::Time::min();  // of scheduling, in the cycle before
  bool scheduled_ = false;                             // ever
  bool to_optimize_ = false;                           // the situation is another one
  Observations observations_;                          // and what they say against the plan
};

}  // namespace roci::planner::utility_htn::cycle
