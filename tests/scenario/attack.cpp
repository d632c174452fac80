#include "tests/scenario/attack.hpp"

#include <sstream>

#include "services/process/domain_claim.hpp"

namespace roci::scenario {
Ended attack(const std::string& script, const std::string& dds) {
  const services::process::DomainClaim domain;
  return run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/" + script +
             " " ROCI_BINARY_DIR "/bin " ROCI_BINARY_DIR "/tests " ROCI_SOURCE_DIR "/missions/planetary " +
             dds + " " + std::to_string(domain.id()));
}

nlohmann::json effects_in(const std::string& output) {
  auto out = nlohmann::json::array();
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("effect ")) out.push_back(nlohmann::json::parse(line.substr(7)));
  return out;
}

}  // namespace roci::scenario
