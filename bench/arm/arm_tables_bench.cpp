// This bench asks the arm's estimates for the function tables of a satellite: all motions from slot to slot and from
// home to each slot, without and with a module, as the functions of missions/orbital do. Motions are drawn in random
// order until all are known or the seconds are spent. It tells the processor time of an exact value and of a lower
// bound. Arm and poses of any number of slots come from bench/growth/lattice.py. From anywhere:
// build/release/bench/bench_arm_tables FOLDER [SECONDS] [SEED]
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <ctime>
#include <iostream>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

#include "arm_svc/estimate.hpp"
#include "arm_svc/setup_file.hpp"

namespace roci::arm {
namespace {

const Payload kModule{120, {0.36, 0.5, 0.5}};  // of missions/orbital/mission.yaml

double processor_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

std::vector<PlacePair> table_of(const MotionModel& model) {
  std::vector<PlacePair> pairs;
  for (const Payload& payload : {Payload{}, kModule}) {
    for (const ResolvedPlace& from : model.poses()) {
      for (const ResolvedPlace& to : model.poses())
        if (to.name != "home") pairs.push_back({{from.name}, {to.name}, payload});
    }
  }
  return pairs;
}

nlohmann::ordered_json measured(const std::string& folder, double seconds, std::uint64_t seed) {
  double begin = processor_s();
  const MotionModel model(load_setup(folder + "/arm.urdf", folder + "/poses.yaml"));
  const double start_s = processor_s() - begin;
  std::vector<PlacePair> pairs = table_of(model);
  std::mt19937_64 random(seed);
  for (std::size_t i = pairs.size(); i > 1; --i) std::swap(pairs[i - 1], pairs[random() % i]);
  EstimateCache cache(pairs.size());
  cache.begin_request();
  begin = processor_s();
  for (const PlacePair& pair : pairs) cache.bound(model, pair);
  const double bounds_s = processor_s() - begin;
  std::vector<double> taken;
  std::size_t found = 0;
  double spent = 0;
  for (std::size_t i = 0; i < pairs.size() && spent < seconds; ++i) {
    begin = processor_s();
    found += cache.estimate(model, {&pairs[i], 1}).front().status == MotionStatus::found ? 1 : 0;
    taken.push_back(processor_s() - begin);
    spent += taken.back();
  }
  std::ranges::sort(taken);
  const double mean_s = spent / static_cast<double>(taken.size());
  return {{"bench", "arm_tables"},
          {"seed", seed},
          {"slots", model.poses().size() - 1},
          {"start_s", start_s},
          {"tuples", pairs.size()},
          {"bounds_s", bounds_s},
          {"exact", taken.size()},
          {"found", found},
          {"exact_s", spent},
          {"mean_ms", 1e3 * mean_s},
          {"median_ms", 1e3 * taken[taken.size() / 2]},
          {"max_ms", 1e3 * taken.back()},
          {"whole_table_s", mean_s * static_cast<double>(pairs.size())}};
}

}  // namespace
}  // namespace roci::arm

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: bench_arm_tables FOLDER [SECONDS] [SEED]\n";
    return 2;
  }
  const double seconds = argc > 2 ? std::strtod(argv[2], nullptr) : 120;
  const std::uint64_t seed = argc > 3 ? std::strtoull(argv[3], nullptr, 10) : 1;
  std::cout << roci::arm::measured(argv[1], seconds, seed).dump() << std::endl;
  return 0;
}
