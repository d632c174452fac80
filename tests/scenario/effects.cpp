#include "tests/scenario/effects.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>
#include <set>

namespace roci::scenario {

using nlohmann::json;

namespace {

const std::set<std::string> kDoneOnce{"image", "pick", "drop", "send"};  // they end their activity

std::string word(const json& effect, const char* name) { return effect.at(name).get<std::string>(); }

}  // namespace

json effects_of(const std::filesystem::path& run_folder) {
  json out = json::array();
  std::ifstream in(run_folder / "effects.jsonl");
  for (std::string line; std::getline(in, line);) out.push_back(json::parse(line));
  return out;
}

std::map<std::string, int> doubled(const json& effects) {
  std::map<std::string, int> out;
  for (const json& effect : effects) {
    const std::string kind = word(effect, "kind");
    if (kind == "detour") continue;  // a drive looks for a way around as often as it must
    const std::string attempt =
        kDoneOnce.contains(kind) ? "" : ", attempt " + std::to_string(effect.at("attempt").get<int>());
    ++out[word(effect, "robot") + "." + word(effect, "component") + " " + kind + " " +
          word(effect, "object") + " by " + word(effect, "activity") + " of " + word(effect, "commander") +
          attempt];
  }
  std::erase_if(out, [](const auto& one) { return one.second == 1; });
  return out;
}

void expect_done_once(const json& effects) {
  ASSERT_TRUE(effects.is_array() && !effects.empty()) << "the robot did nothing, or nobody wrote it down";
  EXPECT_THAT(doubled(effects), ::testing::IsEmpty());
}

std::map<std::string, int> deeds_counted(const json& effects) {
  std::map<std::string, int> out;
  for (const json& effect : effects) ++out[word(effect, "kind") + " " + word(effect, "object")];
  return out;
}

}  // namespace roci::scenario
