// bench_downlink [--seeds N] [--first-seed N] [--products N] [--windows N] [--load X] [--large]
// It measures the Downlink Manager: one large question for each seed, with the gap that is proven, and then the
// questions of a planner that adds tasks as long as their data has room. It prints one JSON object; times are in
// milliseconds of processor time. Exit code 1 when an aim is missed.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>

#include "bench/downlink/questions.hpp"

namespace {

using namespace roci;
using bench::downlink::Random;
using planner::utility_htn::downlink::Assignment, planner::utility_htn::downlink::Limits,
    planner::utility_htn::downlink::Manager, planner::utility_htn::downlink::Product,
    planner::utility_htn::downlink::Proof;

// The aims for a large question.
constexpr double kMost_ms = 1'000;
constexpr double kWidestGap = 0.01;

double processor_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) * 1e3 + static_cast<double>(now.tv_nsec) * 1e-6;
}

double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0;
  std::ranges::sort(values);
  return values[static_cast<std::size_t>(share * static_cast<double>(values.size() - 1))];
}

std::string words(Proof::By by) {
  if (by == Proof::By::certificate) return "certificate";
  return by == Proof::By::solver ? "solver" : "bound";
}

nlohmann::json large(std::uint64_t seed, std::size_t products, std::size_t windows, double load) {
  Random random(seed);
  Limits limits;
  const auto opportunities = bench::downlink::draw_windows(random, windows, limits);
  const auto data = bench::downlink::draw_products(
      random, products, load * bench::downlink::capacity(opportunities), opportunities.back().start);
  const double start = processor_ms();
  const Assignment answer = Manager().assign(data, opportunities, limits);
  const double took = processor_ms() - start;
  return {{"seed", seed},
          {"ms", took},
          {"by", words(answer.proof.by)},
          {"gap", answer.proof.gap},
          {"rank", answer.proof.rank},
          {"left_out", answer.left_out.size()}};
}

// Adds tasks of one to four products, of which each must have room, until twenty in a row have none.
void plan(std::uint64_t seed, Manager& manager, std::vector<double>& times) {
  Random random(seed);
  Limits limits;
  const auto windows = bench::downlink::draw_windows(random, 30, limits);
  std::vector<Product> planned;
  for (int refused = 0, task = 0; refused < 20; ++task) {
    const std::size_t count = 1 + random() % 4;
    auto candidates = bench::downlink::draw_products(
        random, count, static_cast<double>(count) * bench::downlink::capacity(windows) / 100,
        windows.back().start);
    for (Product& candidate : candidates) candidate.id = "task" + std::to_string(task) + "/" + candidate.id;
    const double start = processor_ms();
    const bool admitted = manager.admits(planned, windows, limits, candidates);
    times.push_back(processor_ms() - start);
    if (admitted) planned.insert(planned.end(), candidates.begin(), candidates.end());
    refused = admitted ? 0 : refused + 1;
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Measures the Downlink Manager");
  std::uint64_t seeds = 5;
  std::uint64_t first_seed = 1;
  std::size_t products = 1'000;
  std::size_t windows = 50;
  double load = 1.2;
  app.add_option("--seeds", seeds, "how many questions of each kind");
  app.add_option("--first-seed", first_seed, "the others follow it");
  app.add_option("--products", products, "of a large question");
  app.add_option("--windows", windows, "of a large question");
  app.add_option("--load", load, "bytes of all products over bytes of all windows");
  bool only_large = false;
  app.add_flag("--large", only_large, "large questions alone");
  CLI11_PARSE(app, argc, argv);
  nlohmann::json out{
      {"products", products}, {"windows", windows}, {"load", load}, {"large", nlohmann::json::array()}};
  Manager manager;
  std::vector<double> times;
  double longest_ms = 0, widest_gap = 0;
  for (std::uint64_t seed = first_seed; seed < first_seed + seeds; ++seed) {
    const nlohmann::json& one = out["large"].emplace_back(large(seed, products, windows, load));
    longest_ms = std::max(longest_ms, one["ms"].get<double>());
    widest_gap = std::max(widest_gap, one["gap"].get<double>());
    if (!only_large) plan(seed, manager, times);
  }
  out["planner"] = {{"questions", times.size()},
                    {"by_certificate", manager.counts().certificate},
                    {"share_of_certificate", static_cast<double>(manager.counts().certificate) /
                                                 static_cast<double>(std::max<std::size_t>(times.size(), 1))},
                    {"by_solver", manager.counts().solver},
                    {"open", manager.counts().open},
                    {"median_ms", quantile(times, 0.5)},
                    {"p99_ms", quantile(times, 0.99)},
                    {"max_ms", quantile(times, 1)}};
  const bool fast = longest_ms < kMost_ms, proven = widest_gap <= kWidestGap;
  out["aims"] = {{"large_under_1_s", fast}, {"gap_at_most_1_percent", proven}};
  std::cout << out.dump(1) << "\n";
  return fast && proven ? EXIT_SUCCESS : EXIT_FAILURE;
}
