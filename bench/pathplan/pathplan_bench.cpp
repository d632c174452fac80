// This bench plans paths on the planetary site, by seeded queries between free places. It runs from anywhere:
// build/release/bench/bench_pathplan
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

void table(benchmark::State& state) {
  const PathPlanner fresh = planetary();
  const auto places = free_places(fresh.map(), static_cast<std::size_t>(state.range(0)), 3);
  for (auto _ : state) {
    PathPlanner planner = fresh;
    for (const terrain::Point from : places) {
      for (const terrain::Point to : places) benchmark::DoNotOptimize(planner.path(from, to));
    }
  }
}

BENCHMARK(build)->Unit(benchmark::kMillisecond);
BENCHMARK(first_path)->Unit(benchmark::kMillisecond);
BENCHMARK(further_path)->Unit(benchmark::kMillisecond);
BENCHMARK(table)->Arg(12)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace roci::pathplan

BENCHMARK_MAIN();
