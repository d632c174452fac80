// This bench asks what hierarchical timeline plans cost as problems grow: goals, way-points, rovers, by heuristic.
// Times are the processor's of one thread. From anywhere: build/release/bench/bench_timeline_htn; exit code 1 when an
// aim is missed. With the argument "threads" it asks alone what a second thread brings, five times.
#include <time.h>

#include <cmath>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/timeline_htn/team_traverse.hpp"
#include "planner_svc/timeline_htn/extraction/matrix.hpp"
#include "planner_svc/timeline_htn/extraction/plan_of.hpp"
#include "planner_svc/timeline_htn/reading/load.hpp"
#include "planner_svc/timeline_htn/search/resolvers.hpp"

namespace roci::bench::timeline_htn {
namespace {

using Json = nlohmann::ordered_json;
namespace engine = planner::timeline_htn;
using engine::search::Heuristic;

double seconds_of(clockid_t clock) {
  timespec now{};
  clock_gettime(clock, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double processor_s() { return seconds_of(CLOCK_THREAD_CPUTIME_ID); }

std::string word(Heuristic heuristic) {
  return heuristic == Heuristic::blind          ? "blind"
         : heuristic == Heuristic::relaxed_plan ? "relaxed_plan"
                                                : "landmarks";
}

struct Measured {
  Json json;
  double seconds = 0;
  std::size_t bytes = 0;
};

Measured measure(const TeamTraverse& team, Heuristic heuristic) {
  mission::Findings findings;
  const auto model = engine::reading::parse_model({{"team", text_of(team)}}, findings);
  if (!model) {
    std::cerr << engine::reading::errors_of(findings) << '\n';
    std::exit(2);
  }
  const double begin = processor_s();
  engine::search::Search search(*model, {heuristic, engine::search::Order::first_declared});
  const auto outcome = search.run(300'000, std::size_t{1} << 30U, [] { return false; });
  const bool solved = outcome == engine::search::Outcome::solved;
  std::size_t activities = 0, transitions = 0, timelines = 0;
  if (solved) {
    const auto plan = engine::extraction::plan_of(search, {"bench", "a", temporal::Time{0}});
    activities = plan.activities.size();
    const double end = processor_s();
    const auto matrix = engine::extraction::matrix_of(plan);
    transitions = matrix.transitions.size();
    timelines = matrix.timelines.size();
    const auto& count = search.count();
    return {{{"waypoints", team.waypoints},
             {"rovers", team.rovers},
             {"goals", team.goals},
             {"chords", team.chords},
             {"heuristic", word(heuristic)},
             {"solved", true},
             {"seconds", end - begin},
             {"bytes", count.bytes},
             {"expanded", count.expanded},
             {"evaluated", count.evaluated},
             {"activities", activities},
             {"transitions", transitions},
             {"timelines", timelines}},
            end - begin,
            count.bytes};
  }
  return {{{"waypoints", team.waypoints},
           {"rovers", team.rovers},
           {"goals", team.goals},
           {"chords", team.chords},
           {"heuristic", word(heuristic)},
           {"solved", false},
           {"reason", search.reason()},
           {"evaluated", search.count().evaluated}},
          processor_s() - begin,
          search.count().bytes};
}

// Four resolvers on one and two threads: wall time, since that is what threads are for.
Json threads_of(const TeamTraverse& team) {
  using engine::search::Order;
  const std::vector<engine::search::Resolver> resolvers{{Heuristic::blind, Order::first_declared},
                                                        {Heuristic::blind, Order::last_declared},
                                                        {Heuristic::relaxed_plan, Order::first_declared},
                                                        {Heuristic::landmarks, Order::first_declared}};
  mission::Findings findings;
  const auto model = engine::reading::parse_model({{"team", text_of(team)}}, findings);
  Json out;
  std::vector<double> seconds;
  for (const std::size_t threads : {1, 2}) {
    const double begin = seconds_of(CLOCK_MONOTONIC);
    const auto result = engine::search::resolve(*model, resolvers, threads, 2'000'000, std::size_t{1} << 30U,
                                                [] { return false; });
    seconds.push_back(seconds_of(CLOCK_MONOTONIC) - begin);
    out.push_back({{"threads", threads},
                   {"wall_s", seconds.back()},
                   {"winner", result.resolver},
                   {"evaluated", result.evaluated},
                   {"solved", result.outcome == engine::search::Outcome::solved}});
  }
  out.push_back({{"speed_up", seconds[0] / seconds[1]}});
  return out;
}

int run_threads() {
  Json out;
  for (int i = 0; i < 5; ++i) out.push_back(threads_of({.waypoints = 100, .chords = 2}));
  std::cout << out.dump(1) << '\n';
  return 0;
}

int run() {
  bool kept = true;
  Json out;
  const Measured trial = measure({}, Heuristic::blind);
  kept = trial.seconds < 0.1 && trial.bytes < (64U << 20U);
  out["trial"] = trial.json;
  for (const Heuristic heuristic : {Heuristic::blind, Heuristic::relaxed_plan, Heuristic::landmarks}) {
    Json& rows = out[word(heuristic)];
    double first = 0, last = 0;
    for (const int goals : {1, 2, 5, 10, 20}) {
      const Measured one = measure({2 * goals + 1, 2, goals, 0}, heuristic);
      if (goals == 5) first = one.seconds;
      if (goals == 20) last = one.seconds;
      rows["goals"].push_back(one.json);
    }
    const double slope = std::log(last / first) / std::log(4.0);
    rows["slope_over_goals"] = slope;
    kept = kept && slope < 2;
    for (const int waypoints : {4, 10, 25, 50, 100})
      rows["waypoints"].push_back(measure({waypoints, 2, 2, 2}, heuristic).json);
    for (const int rovers : {2, 3, 4}) rows["rovers"].push_back(measure({13, rovers, 2, 0}, heuristic).json);
  }
  out["threads"] = threads_of({.waypoints = 100, .chords = 2});
  out["kept"] = kept;
  std::cout << out.dump(1) << '\n';
  return kept ? 0 : 1;
}

}  // namespace
}  // namespace roci::bench::timeline_htn

int main(int argc, char** argv) {
  const bool threads = argc == 2 && std::string(argv[1]) == "threads";
  return threads ? roci::bench::timeline_htn::run_threads() : roci::bench::timeline_htn::run();
}
