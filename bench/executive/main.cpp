// bench_executive [--sizes N …] [--shapes S …] [--steps N] [--seed N]
// It measures what one event costs the executive, by size and shape of the plan: a stand-in owner accepts
// each command at once and ends it after 10 to 12 s. It prints one JSON object; times are in microseconds of
// processor time.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <ctime>
#include <iostream>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "bench/executive/plans.hpp"
#include "exec_svc/executive/executive.hpp"

namespace {

using namespace roci;
using temporal::Duration;
using temporal::Time;

double processor_us() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e6 + static_cast<double>(now.tv_nsec) * 1e-3;
}

// Holds the owner's answers to come, by time.
using Answers = std::multimap<Time, exec::executive::CommandAck>;

void obey(const exec::executive::Outputs& outputs, Time now, std::mt19937_64& random, Answers& answers) {
  for (const exec::executive::Command& command : outputs.commands) {
    const Duration lasts = temporal::seconds(10) + Duration{static_cast<std::int64_t>(random() % 2'000'000)};
    answers.emplace(now, exec::executive::CommandAck{command.activity, command.attempt,
                                                     exec::executive::CommandStage::accepted, "", ""});
    answers.emplace(now + lasts,
                    exec::executive::CommandAck{command.activity, command.attempt,
                                                exec::executive::CommandStage::completed, "", ""});
  }
}

nlohmann::json figures(std::vector<double> us) {
  std::sort(us.begin(), us.end());
  double sum = 0;
  for (const double one : us) sum += one;
  const auto at = [&us](double part) {
    return us[static_cast<std::size_t>(part * static_cast<double>(us.size() - 1))];
  };
  return {{"steps", us.size()},
          {"mean_us", sum / static_cast<double>(us.size())},
          {"median_us", at(0.5)},
          {"p99_us", at(0.99)},
          {"max_us", us.back()}};
}

// Makes at most `steps` steps, which is enough to see what one costs.
nlohmann::json measure(const std::string& shape, std::size_t size, std::size_t steps, std::uint64_t seed) {
  std::mt19937_64 random(seed);
  temporal::FlexiblePlan plan = bench::plan_of(shape, size, random);
  exec::executive::Executive executive;
  const double before = processor_us();
  if (const auto faults = executive.load(std::move(plan), Time{0}); !faults.empty())
    throw std::logic_error(shape + ": " + faults.front());
  const double load_us = processor_us() - before;
  Answers answers;
  std::vector<double> us;
  Time now{0};
  while (us.size() < steps) {
    exec::executive::Inputs inputs;
    while (!answers.empty() && answers.begin()->first <= now)
      inputs.acks.push_back(std::move(answers.extract(answers.begin()).mapped()));
    const double begun = processor_us();
    const exec::executive::Outputs outputs = executive.step(now, inputs);
    us.push_back(processor_us() - begun);
    if (outputs.outcome.kind != exec::executive::OutcomeKind::running) {
      if (outputs.outcome.kind != exec::executive::OutcomeKind::finished)
        throw std::logic_error(shape + ": the plan broke: " + outputs.outcome.reason);
      break;
    }
    obey(outputs, now, random, answers);
    Time next = answers.empty() ? temporal::no_bound : answers.begin()->first;
    if (outputs.next_wake) next = std::min(next, *outputs.next_wake);
    now = std::max(now, next);
  }
  nlohmann::json out = figures(std::move(us));
  out["load_us"] = load_us;
  return out;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("What one event costs the executive, by size and shape of the plan");
  std::vector<std::size_t> sizes{10, 100, 1000, 10000};
  std::vector<std::string> shapes = bench::shapes();
  std::size_t steps = 4000;
  std::uint64_t seed = 1;
  app.add_option("--sizes", sizes, "numbers of activities")->check(CLI::PositiveNumber);
  app.add_option("--shapes", shapes, "shapes of the plans")->check(CLI::IsMember(bench::shapes()));
  app.add_option("--steps", steps, "most steps per plan")->check(CLI::PositiveNumber);
  app.add_option("--seed", seed, "of plans and durations");
  CLI11_PARSE(app, argc, argv);
  try {
    nlohmann::json record{{"bench", "executive"}, {"seed", seed}};
    for (const std::string& shape : shapes)
      for (const std::size_t size : sizes)
        record["results"][shape][std::to_string(size)] = measure(shape, size, steps, seed);
    std::cout << record.dump(2) << std::endl;
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bench_executive: " << error.what() << std::endl;
    return 1;
  }
}
