// This file reads what mission.yaml says of commands: actions with their policies, contingencies, and the
// recovery strategy. Every reader throws roci::mission::FileError with the place and the remedy.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "core/mission/entry.hpp"
#include "exec_svc/mission/mission_model.hpp"

namespace roci::exec::mission {

executive::Contingency read_contingency(const std::string& name, const roci::mission::Entry& entry,
                                        const std::vector<Component>& components);

ActionBinding read_action(const roci::mission::Entry& entry, const std::vector<Component>& components,
                          const std::map<std::string, executive::Contingency>& contingencies);

/// Reads what the ground may change in flight; uploads are contingencies of the mission.
GroundModel read_ground(const roci::mission::Entry& entry,
                        const std::map<std::string, executive::Contingency>& contingencies);

RecoveryStrategy read_strategy(const roci::mission::Entry& entry);
executive::StartPolicy read_start(const roci::mission::Entry& entry);
Replanning read_replanning(const roci::mission::Entry& entry);

AutonomyLevel read_autonomy(const roci::mission::Entry& entry);

/// Reads a whole number from `least` to 1000000, or returns the fallback where the key is missing.
std::uint32_t count_or(const roci::mission::Entry& parent, const char* key, std::uint32_t fallback,
                       std::uint32_t least);

}  // namespace roci::exec::mission
