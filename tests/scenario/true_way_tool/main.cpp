// Says for a scenario and a range of seeds whether a way exists for the primary on the true map:
// true-way MISSION SCENARIO FIRST LAST
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>

#include "tests/scenario/true_way.hpp"

int main(int count, char** words) try {
  using namespace roci::scenario;
  if (count != 5) {
    std::cerr << "use: true-way MISSION SCENARIO FIRST_SEED LAST_SEED\n";
    return 2;
  }
  const unsigned long first = std::stoul(words[3]), last = std::stoul(words[4]);
  for (unsigned long seed = first; seed <= last; ++seed) {
    const roci::sim::world::Ground ground = true_ground(words[1], words[2], seed);
    const auto way = true_way(ground, kYardPrimary, kYardStart, kYardTarget);
    nlohmann::json line{{"seed", seed}, {"exists", way.has_value()}, {"traps", nlohmann::json::array()}};
    if (way) line["length_m"] = way->length_m;
    for (const auto& trap : ground.surface.soil.areas)
      line["traps"].push_back({{"x", trap.centre.x}, {"y", trap.centre.y}, {"radius", trap.radius}});
    std::cout << line.dump() << '\n';
  }
} catch (const std::exception& error) {
  std::cerr << "true-way: " << error.what() << '\n';
  return 1;
}
