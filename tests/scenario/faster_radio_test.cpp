// The trial of missions/faster behind a radio that loses a fifth of what is said and is away for minutes, one flight for
// each of fifty seeds.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "core/temporal/value.hpp"
#include "services/topics.hpp"
#include "services/wire/plan_wire.hpp"
#include "tests/scenario/heard_flight.hpp"
#include "tests/scenario/radio_losses.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct FasterRadio : ::testing::TestWithParam<std::uint64_t> {
  FasterRadio() {
    fs::create_directories(folder);
    fs::copy(ROCI_SOURCE_DIR "/missions/faster", folder / "faster", fs::copy_options::recursive);
  }
  ~FasterRadio() override { fs::remove_all(folder); }
  const fs::path folder = fs::temp_directory_path() / ("roci_faster_radio_" + std::to_string(::getpid()));
};

// `map_within_s` of FollowPath in missions/faster/primary_locomotion.yaml and of TraverseWithSS in scout_locomotion.yaml.
constexpr double kBound_s = 300;

double told_s(const v1::CommandAck& answer) {
  for (const v1::NamedValue& value : answer.outcome().measured())
    if (value.name() == "told_s") return value.held().number();
  return -1;
}

bool leads_over_a_way(const v1::Command& command) {
  return std::ranges::any_of(command.arguments(),
                             [](const v1::Property& one) { return one.name() == "way"; });
}

// How old the scout's newest patch in the primary's map was as each drive over a way of that map was commanded, in
// seconds: by the merge that the dedicated executive had an answer to last.
std::vector<double> map_ages(const HeardFlight& flight, const std::string& executive) {
  std::vector<double> out;
  for (const v1::Command& command : flight.commands) {
    if (command.commander() != executive || command.command_name() != "drive" ||
        command.action() != v1::COMMAND_EXECUTE || !leads_over_a_way(command))
      continue;
    double told = -1;
    for (const v1::CommandAck& answer : flight.answers)
      if (answer.commander() == command.commander() && answer.owner() == "primary.path" &&
          answer.stage() == v1::STAGE_COMPLETED && answer.header().stamp_us() <= command.header().stamp_us())
        told = std::max(told, told_s(answer));
    out.push_back(double(command.header().stamp_us()) / 1e6 - told);
  }
  return out;
}

// What one decision of the plan has really done, whatever became of its calls and attempts.
using Decision = std::string;
std::map<Decision, std::vector<std::string>> effects_of(const HeardFlight& flight) {
  std::map<Decision, std::vector<std::string>> out;
  for (const json& deed : flight.deeds) {
    const auto call = deed["activity"].get<std::string>();  // exec_svc/EPOCH/ACTIVITY/NUMBER
    const auto slash = call.find('/', call.find('/') + 1) + 1;
    out[call.substr(slash, call.rfind('/') - slash)].push_back(deed["kind"].get<std::string>() + " " +
                                                               deed["object"].get<std::string>());
  }
  return out;
}

// How often a dedicated executive has come back from a hazard within each decision: each time it drives twice more.
std::map<Decision, std::size_t> hazards_avoided(const HeardFlight& flight) {
  std::map<Decision, std::size_t> out;
  std::map<std::string, Decision> under_way;  // by owner
  for (const HeardSample& one : flight.order) {
    if (one.topic == services::topics::command.name) {
      const v1::Command& command = flight.commands[one.index];
      if (command.commander() == "exec_svc" && command.action() == v1::COMMAND_EXECUTE)
        under_way[command.owner()] = command.activity();
    } else if (one.topic == services::topics::observation.name) {
      const v1::Observation& seen = flight.observations[one.index];
      const std::string state = temporal::to_text(services::wire::from_wire(seen.observed()));
      if (state.starts_with("avoiding_hazard") || state.starts_with("backing_out"))
        ++out[under_way[seen.timeline()]];  // a dedicated executive has the name of its timeline
    }
  }
  return out;
}

// One effect for each decision, and what its repairs drive besides: back, and on. So it never goes to one place twice
// in a row.
void expect_one_effect(const HeardFlight& flight) {
  const auto avoided = hazards_avoided(flight);
  const auto effects = effects_of(flight);
  EXPECT_GE(effects.size(), 19U) << "a drive of each rover for each way, and the last communication";
  for (const auto& [decision, done] : effects) {
    const auto repaired = avoided.find(decision);
    EXPECT_LE(done.size(), 1 + (repaired == avoided.end() ? 0 : 2 * repaired->second)) << decision;
    EXPECT_TRUE(std::ranges::adjacent_find(done) == done.end()) << decision;
  }
}

// The target is reached, no decision has two effects, no rover drives on a map that is older than stated, and what was
// lost has a name for what is done about it.
TEST_P(FasterRadio, TheTeamArrivesAndNothingIsDoneTwice) {
  const HeardFlight flight = hear_flight(folder / "faster", "radio_loss", folder / "run", GetParam());
  const std::string result = flight.summary.value("result", "");
  EXPECT_EQ(result, "achieved");
  expect_one_effect(flight);
  double oldest = 0;
  for (const char* executive : {"primary.locomotion", "scout.locomotion"}) {
    const std::vector<double> ages = map_ages(flight, executive);
    EXPECT_GE(ages.size(), 9U) << "one for each way of the route";
    EXPECT_THAT(ages, ::testing::Each(::testing::Le(kBound_s))) << executive;
    for (const double age : ages) oldest = std::max(oldest, age);
  }
  RecordProperty("oldest_map_s", std::to_string(oldest));
  RecordProperty("replans", flight.summary["replans"].dump());
  const auto all = losses_of(folder / "run");
  EXPECT_FALSE(all.empty());
  for (const auto& [service, losses] : all) {
    for (const json& loss : losses) {
      EXPECT_NE(loss["effect"], "never heard") << loss;
      if (loss["effect"] == "asked for") expect_asked_for(flight, loss);
    }
    expect_all_named(folder / "run", service, losses);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, FasterRadio, ::testing::Range<std::uint64_t>(1, 51),
                         [](const auto& test) { return "seed_" + std::to_string(test.param); });

}  // namespace
}  // namespace roci::scenario
