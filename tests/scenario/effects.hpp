// Physical effects: what a robot's components really did to the world, as it wrote it down when it happened
// (effects.jsonl, sim_svc/README.md). No rule of an owner of commands stands before that, and a robot that is started
// again appends.
#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <string>

namespace roci::scenario {

/// Returns the effects of a run as one array, in their order.
nlohmann::json effects_of(const std::filesystem::path& run_folder);

/// Returns how often each effect came that one command had more than once, whatever epoch its key names, and each deed
/// (image, pick, drop, send) that one activity did more than once, whatever attempt: the rule of bench/kill/effects.py.
std::map<std::string, int> doubled(const nlohmann::json& effects);

/// Fails the test if there are no effects, or one is doubled.
void expect_done_once(const nlohmann::json& effects);

/// Returns how often each thing was done, by whatever command: "image ridge" → count.
std::map<std::string, int> deeds_counted(const nlohmann::json& effects);

}  // namespace roci::scenario
