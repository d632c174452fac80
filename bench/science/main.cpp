// Measures the detector of science_svc on rendered images with known odd targets, against one that guesses.
#include <CLI/CLI.hpp>
#include <array>
#include <cstdio>
#include <fstream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "bench/science/sheet.hpp"
#include "bench/science/trials.hpp"

namespace {

constexpr std::array kThresholds{0.5, 0.6, 0.7, 0.75, 0.8, 0.85, 0.9};
constexpr int kGuesses = 50;  // draws of the random detector, whose counts are averaged

}  // namespace

int main(int argc, char** argv) {
  using namespace roci::bench::science;
  CLI::App app{
      "Precision and recall of science_svc's detector on rendered images, beside a detector that raises as "
      "many goals "
      "at random. Prints JSON.",
      "bench_science"};
  std::uint64_t seed = 1001;
  int worlds = 30, images = 10;
  double reach = 12, threshold = 0.85;
  std::string sheet_file;
  app.add_option("--seed", seed, "of the first world; 1 to 1000 were used for tuning")->capture_default_str();
  app.add_option("--worlds", worlds, "each with a site of its own")
      ->check(CLI::Range(1, 1000))
      ->capture_default_str();
  app.add_option("--images", images, "of each world")->check(CLI::Range(1, 1000))->capture_default_str();
  app.add_option("--reach", reach, "metres, as `reach_m` of mission.yaml")->capture_default_str();
  app.add_option("--threshold", threshold, "of the sheet")->capture_default_str();
  app.add_option("--sheet", sheet_file, "writes images with the finds marked, as PPM");
  CLI11_PARSE(app, argc, argv);
  std::vector<World> all;
  for (int i = 0; i < worlds; ++i)
    all.push_back(make_world(seed + static_cast<std::uint64_t>(i), images, reach));
  nlohmann::json out{{"first_seed", seed},
                     {"images", worlds * images},
                     {"reach_m", reach},
                     {"rows", nlohmann::json::array()}};
  for (const double one : kThresholds) {
    const Score score = detect(all, one, reach);
    Score by_chance;
    for (int i = 0; i < kGuesses; ++i) by_chance.add(guess(all, score.goals, static_cast<std::uint64_t>(i)));
    out["targets"] = score.to_find;
    out["rows"].push_back({{"threshold", one},
                           {"goals", score.goals},
                           {"precision", score.precision()},
                           {"recall", score.recall()},
                           {"random_precision", by_chance.precision()},
                           {"random_recall", by_chance.recall()}});
  }
  std::puts(out.dump(2).c_str());
  if (!sheet_file.empty())
    std::ofstream(sheet_file, std::ios::binary) << sheet(all, threshold, reach, 4, 5, 3);
  return 0;
}
