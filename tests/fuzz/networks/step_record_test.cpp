// The record of an engine's steps, as a disk may have damaged it: what is read was written, and the rest is refused with
// its place.
#include "planner_svc/engine/step_record.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <sstream>
#include <string>

#include "core/bytes/fnv_1a.hpp"
#include "core/bytes/little_endian.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/cli/cycle.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"
#include "tests/fuzz/files/damage.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

namespace engine = planner::engine;
namespace cli = planner::utility_htn::cli;

std::string flight() {
  engine::Setup setup;
  setup.engine = "utility_htn";
  planner::utility_htn::adapter::UtilityEngine flown(
      setup,
      planner::utility_htn::reading::load_network(ROCI_SOURCE_DIR "/tests/missions/lander/network.yaml"));
  std::string out = engine::record_head({setup.engine, "", {}, flown.packed_model()});
  for (int minute = 0; minute < 5; ++minute) {
    engine::StepInputs inputs;
    inputs.now = temporal::seconds(60.0 * minute);
    inputs.receipt = engine::Receipt{0, 0, "", "", true};
    inputs.observations = {{"lander.battery", 600'000.0 - minute, inputs.now}};
    if (minute == 0) inputs.goals.emplace_back().issuer = "ground";
    out += engine::record_entry(inputs) + engine::record_entry(engine::outcome_of(flown.step(inputs)));
  }
  return out;
}

TEST(FuzzStepRecords, ADamagedRecordIsPlannedAgainOrRefusedWithItsPlace) {
  const std::string whole = flight();
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("roci-fuzz-steps-" + std::to_string(getpid()));
  std::mt19937_64 random{17};
  for (int round = 0; round < rounds(300); ++round) {
    write_bytes(file, round == 0 ? whole : damaged(whole, random));
    std::ostringstream out, errors;
    const cli::ExitCode code = cli::cycle(file, 0, {out, errors, false});
    if (round == 0) {
      ASSERT_EQ(code, cli::done) << errors.str();
    }
    ASSERT_NE(code, cli::wrong_use);
    if (code == cli::faulty) {
      ASSERT_NE(out.str() + errors.str(), "");
    }
  }
  std::filesystem::remove(file);
}

// An entry of inputs as a planner writes it (step_record.hpp).
std::string entry_of(const std::string& body) {
  std::string out = "I";
  bytes::append_little_endian(out, body.size(), 4);
  out += body;
  bytes::append_little_endian(out, bytes::fnv_1a(out), 8);
  return out;
}

// The checksum is made anew, so that damages come as far as the fields.
TEST(FuzzStepRecords, DamagedFieldsAreReadOrRefused) {
  const std::string head = engine::record_head({"utility_htn", "", {}, "model"});
  engine::StepInputs inputs;
  inputs.goals.emplace_back().id = "g";
  inputs.observations = {{"lamp", temporal::state("lit", {"a"}), temporal::seconds(1)}};
  inputs.executed.emplace().activities.emplace_back().pre =
      temporal::compare("battery", temporal::ConditionOp::ge, 5.0);
  const std::string entry = engine::record_entry(inputs);
  const std::string body = entry.substr(5, entry.size() - 13);
  ASSERT_EQ(entry_of(body), entry);
  std::mt19937_64 random{19};
  for (int round = 0; round < rounds(2'000); ++round) {
    const std::string bytes = head + entry_of(damaged(body, random));
    try {
      engine::StepRecordReader reader(bytes);
      while (reader.next()) continue;
    } catch (const engine::StepRecordError& error) {
      ASSERT_TRUE(std::string(error.what()).starts_with("at byte ")) << error.what();
    }
  }
}

}  // namespace
}  // namespace roci::fuzz
