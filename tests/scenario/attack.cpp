#include "tests/scenario/attack.hpp"

#include <sstream>

#include "services/process/domain_claim.hpp"

namespace roci::scenario {
namespace {

std::string name_of(const nlohmann::json& effect) {
  return effect["kind"].get<std::string>() + " " + effect["object"].get<std::string>() + " by " +
         effect["activity"].get<std::string>() + " " + std::to_string(effect["attempt"].get<int>());
}

template <class Name>
std::map<std::string, int> counted(const std::string& output, Name name) {
  std::map<std::string, int> out;
  std::istringstream lines(output);
  for (std::string line; std::getline(lines, line);)
    if (line.starts_with("effect ")) ++out[name(nlohmann::json::parse(line.substr(7)))];
  return out;
}

}  // namespace

Ended attack(const std::string& script, const std::string& dds) {
  const services::process::DomainClaim domain;
  return run("timeout 200 " ROCI_SOURCE_DIR "/tests/scenario/" + script +
             " " ROCI_BINARY_DIR "/bin " ROCI_BINARY_DIR "/tests " ROCI_SOURCE_DIR "/missions/planetary " +
             dds + " " + std::to_string(domain.id()));
}

std::map<std::string, int> effects_in(const std::string& output) { return counted(output, name_of); }

std::map<std::string, int> effects_by_epoch_in(const std::string& output) {
  return counted(output, [](const nlohmann::json& effect) {
    return name_of(effect) + " of " + std::to_string(effect["epoch"].get<int>());
  });
}

}  // namespace roci::scenario
