// This bench plans paths on the planetary site, by seeded queries between free places. It runs from anywhere:
// build/release/bench/bench_pathplan [--benchmark_filter=table_of_lower_bounds]. The tables take minutes.
#include <benchmark/benchmark.h>

#include <random>
#include <string>
#include <vector>

#include "core/mission/entry.hpp"
#include "core/terrain/site_file.hpp"
#include "pathplan_svc/path_planner.hpp"
#include "pathplan_svc/rover_file.hpp"

namespace roci::pathplan {
namespace {

const std::string kMission = std::string(ROCI_SOURCE_DIR) + "/missions/planetary";

PathPlanner planetary() {
  const Rover rover = read_rover(mission::Entry::load(kMission + "/mission.yaml").at("rover"));
  return {terrain::load_site(kMission + "/site/site.yaml"), rover.limits, rover.drive};
}

std::vector<terrain::Point> free_places(const Costmap& map, std::size_t count, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<terrain::Point> places;
  while (places.size() < count) {
    const terrain::Point p{static_cast<double>(random() % 24000) / 100,
                           static_cast<double>(random() % 24000) / 100};
    if (map.is_free(p)) places.push_back(p);
  }
  return places;
}

void build(benchmark::State& state) {
  const terrain::Site site = terrain::load_site(kMission + "/site/site.yaml");
  for (auto _ : state) benchmark::DoNotOptimize(PathPlanner(site, {}, {}));
}

// Each path leads from a place that was not asked about before, so that the grid search is included.
void first_path(benchmark::State& state) {
  PathPlanner planner = planetary();
  const auto places = free_places(planner.map(), 200000, 1);
  std::size_t i = 0;
  for (auto _ : state) {
    benchmark::DoNotOptimize(planner.path(places[i % places.size()], places[(i + 1) % places.size()]));
    ++i;
  }
}

void further_path(benchmark::State& state) {
  PathPlanner planner = planetary();
  const auto places = free_places(planner.map(), 200000, 2);
  std::size_t i = 1;
  for (auto _ : state) benchmark::DoNotOptimize(planner.path(places[0], places[i++ % places.size()]));
}

void fill(PathPlanner& planner, const std::vector<terrain::Point>& places) {
  for (const terrain::Point from : places) {
    for (const terrain::Point to : places) benchmark::DoNotOptimize(planner.cost(from, to));
  }
}

// All times and energies between n places, from nothing: n searches over the grid, n² paths.
void table(benchmark::State& state) {
  const PathPlanner fresh = planetary();
  const auto places = free_places(fresh.map(), static_cast<std::size_t>(state.range(0)), 3);
  for (auto _ : state) {
    PathPlanner planner = fresh;
    fill(planner, places);
  }
}

// The same table again after a rock of 1 m radius was found: what was worked out anew is counted, too.
void table_after_hazard(benchmark::State& state) {
  PathPlanner filled = planetary();
  const auto places = free_places(filled.map(), static_cast<std::size_t>(state.range(0)), 3);
  fill(filled, places);
  std::mt19937_64 random(4);
  PlannerWork work;
  for (auto _ : state) {
    state.PauseTiming();
    PathPlanner planner = filled;
    const terrain::Point rock{static_cast<double>(random() % 24000) / 100,
                              static_cast<double>(random() % 24000) / 100};
    state.ResumeTiming();
    planner.set_discs({{rock, 1}});
    fill(planner, places);
    work.searches += planner.work().searches - filled.work().searches;
    work.paths += planner.work().paths - filled.work().paths;
  }
  const auto rounds = static_cast<double>(state.iterations());
  state.counters["searches"] = static_cast<double>(work.searches) / rounds;
  state.counters["paths"] = static_cast<double>(work.paths) / rounds;
}

// The same table as lower bounds; `ratio` is the mean of bound by exact time over pairs that are not the same place.
void table_of_lower_bounds(benchmark::State& state) {
  PathPlanner planner = planetary();
  const auto places = free_places(planner.map(), static_cast<std::size_t>(state.range(0)), 3);
  for (auto _ : state) {
    for (const terrain::Point from : places) {
      for (const terrain::Point to : places) benchmark::DoNotOptimize(planner.lower_bound(from, to));
    }
  }
  double time = 0;
  double energy = 0;
  int pairs = 0;
  for (std::size_t i = 1; i < places.size() && i <= 100; ++i) {
    const PathOutcome exact = planner.cost(places[i - 1], places[i]);
    if (exact.status != PathStatus::found || exact.time == 0) continue;
    const PathOutcome bound = planner.lower_bound(places[i - 1], places[i]);
    time += bound.time / exact.time;
    energy += bound.energy / exact.energy;
    ++pairs;
  }
  state.counters["time_ratio"] = time / pairs;
  state.counters["energy_ratio"] = energy / pairs;
}

BENCHMARK(build)->Unit(benchmark::kMillisecond);
BENCHMARK(first_path)->Unit(benchmark::kMillisecond);
BENCHMARK(further_path)->Unit(benchmark::kMillisecond);
BENCHMARK(table)->Arg(10)->Arg(25)->Arg(50)->Arg(100)->Arg(200)->Iterations(1)->Unit(benchmark::kMillisecond);
BENCHMARK(table_after_hazard)->Arg(10)->Arg(25)->Arg(50)->Iterations(8)->Unit(benchmark::kMillisecond);
BENCHMARK(table_of_lower_bounds)->Arg(10)->Arg(50)->Arg(200)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace roci::pathplan

BENCHMARK_MAIN();
