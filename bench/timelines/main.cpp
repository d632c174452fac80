// This bench asks what timelines cost as they grow: placing a task among 1,000 to 100,000 impacts that lie equally
// dense, finding the valid starts of a task among 100,000 of which 100 are on its timelines, and one step of a search
// on a battery that all tasks share. From anywhere: build/release/bench/bench_timelines [SEED];
// exit code 1 when an aim is missed.
#include <time.h>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "core/temporal/timelines/timelines.hpp"

namespace roci::temporal::timelines {
namespace {

using Json = nlohmann::ordered_json;

/// Returns microseconds of this thread's processor, so that neighbours do not count.
double processor_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e6 * static_cast<double>(now.tv_sec) + 1e-3 * static_cast<double>(now.tv_nsec);
}

double share_of(std::vector<double> values, double share) {
  std::ranges::sort(values);
  return values[std::min(values.size() - 1,
                         static_cast<std::size_t>(share * static_cast<double>(values.size())))];
}

Json told(const std::vector<double>& us) {
  return {{"median_us", share_of(us, 0.5)}, {"p99_us", share_of(us, 0.99)}, {"longest_us", share_of(us, 1)}};
}

/// Is a world of batteries, each with the impacts of its tasks at random in the time that is given.
struct World {
  World(std::uint64_t seed, std::size_t lines, double end_s)
      : random(seed),
        end(end_s),
        timelines(std::vector<Definition>(
                      lines, {.name = "battery", .kind = Kind::cumulative_rate, .initial = 1e9, .lowest = 0}),
                  Extent{.end = seconds(end_s)}) {}

  double number(double low, double high) { return std::uniform_real_distribution(low, high)(random); }
  /// Returns a task of 100 s with two impacts: what it draws while it runs and what it has taken in the end.
  Footprint task(Index line) {
    return {seconds(100),
            {{line, ImpactKind::rate, ImpactWhen::during, -number(1, 100)},
             {line, ImpactKind::delta, ImpactWhen::at_end, -number(1, 100)}},
            {{.timeline = line, .phase = Phase::pre, .lowest = 1000}}};
  }
  Time start() { return seconds(number(0, end - 100)); }
  void fill(std::size_t impacts, Index line) {
    for (std::size_t i = 0; i < impacts / 2; ++i) timelines.place(next++, task(line), start());
  }

  std::mt19937_64 random;
  double end;
  Timelines timelines;
  TaskId next = 0;
};

/// Each impact has 30 s of the one timeline for itself, however many there are.
Json placing(std::uint64_t seed, std::size_t impacts) {
  World world(seed, 1, 30.0 * static_cast<double>(impacts));
  world.fill(impacts, 0);
  std::vector<double> us;
  for (int i = 0; i < 20'000; ++i) {
    const Footprint task = world.task(0);
    const Time start = world.start();
    const std::size_t mark = world.timelines.mark();
    const double begin = processor_us();
    world.timelines.place(world.next, task, start);
    us.push_back(processor_us() - begin);
    world.timelines.undo(mark);
  }
  return told(us);
}

/// 1,000 timelines with 100 impacts each.
Json starts_among(std::uint64_t seed) {
  World world(seed, 1000, 2e6);
  for (Index line = 0; line < 1000; ++line) world.fill(100, line);
  std::vector<double> us;
  for (int i = 0; i < 2'000; ++i) {
    Footprint task = world.task(static_cast<Index>(world.random() % 1000));
    task.constraints[0].lowest = world.number(9.9e8, 1e9);
    const double begin = processor_us();
    static_cast<void>(world.timelines.valid_starts(task, {Time{0}, seconds(2e6)}));
    us.push_back(processor_us() - begin);
  }
  return told(us);
}

/// One step of a search on one battery: the first valid start, a placement there, and back.
Json searching(std::uint64_t seed, std::size_t impacts) {
  World world(seed, 1, 30.0 * static_cast<double>(impacts));
  world.fill(impacts, 0);
  std::vector<double> us;
  for (int i = 0; i < 2'000; ++i) {
    const Footprint task = world.task(0);
    const Interval window{world.start(), seconds(world.end)};
    const double begin = processor_us();
    const std::size_t mark = world.timelines.mark();
    if (const auto start = world.timelines.first_valid_start(task, window))
      world.timelines.place(world.next, task, *start);
    world.timelines.undo(mark);
    us.push_back(processor_us() - begin);
  }
  return told(us);
}

int measure(std::uint64_t seed) {
  Json report{{"bench", "timelines"}, {"seed", seed}};
  for (const std::size_t impacts : {1'000U, 10'000U, 100'000U}) {
    report["place"][std::to_string(impacts)] = placing(seed, impacts);
    report["search_step"][std::to_string(impacts)] = searching(seed, impacts);
  }
  report["valid_starts_among_100000"] = starts_among(seed);
  const double ratio = report["place"]["100000"]["median_us"].get<double>() /
                       report["place"]["1000"]["median_us"].get<double>();
  const double starts_us = report["valid_starts_among_100000"]["longest_us"].get<double>();
  report["place_ratio"] = ratio;
  report["aims"] = {{"place_ratio_at_most_2", ratio <= 2}, {"valid_starts_under_1_ms", starts_us < 1000}};
  std::cout << report.dump(2) << '\n';
  return ratio <= 2 && starts_us < 1000 ? EXIT_SUCCESS : EXIT_FAILURE;
}

}  // namespace
}  // namespace roci::temporal::timelines

int main(int argc, char** argv) {
  if (argc > 2 || (argc == 2 && std::string(argv[1]).find_first_not_of("0123456789") != std::string::npos)) {
    std::cerr << "usage: bench_timelines [SEED]\n";
    return 2;
  }
  return roci::temporal::timelines::measure(argc == 2 ? std::strtoull(argv[1], nullptr, 10) : 1);
}
