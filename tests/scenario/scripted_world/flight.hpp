// Flights of real processes in a scripted world: exec_svc alone or as a pair, under the launcher.
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace roci::scenario {

struct ScriptedFlight {
  int exit_code = -1;
  nlohmann::json summary;
  nlohmann::json heard;                ///< of the world
  std::vector<std::string> decisions;  ///< "d1 1": id and state, as they were traced
  std::vector<std::string> answered;   ///< "ground/w 0": answer and outcome, likewise
  std::vector<std::string> orders;     ///< "ground/1 0": order and stage, likewise
  std::vector<std::string> images;     ///< commanded, in order
  std::vector<std::string> events;
  nlohmann::json replayed;  ///< by roci replay
  long count(const std::string& code) const;
};

// `environment`: "NAME=value …"; `more`: options of the launcher; `mission_more`: appended to mission.yaml.
ScriptedFlight fly_scripted(const std::string& environment, const std::string& more,
                            const std::string& mission_more = "");

}  // namespace roci::scenario
