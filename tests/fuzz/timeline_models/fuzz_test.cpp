// Whatever stands in the files of a model, it is taken, or refused with its place; nothing else comes out.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <random>
#include <string>

#include "core/mission/model_text.hpp"
#include "planner_svc/timeline_htn/model/check.hpp"
#include "planner_svc/timeline_htn/reading/load.hpp"
#include "tests/fuzz/files/damage.hpp"
#include "tests/fuzz/missions/mutate.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

namespace fs = std::filesystem;
namespace timeline_htn = planner::timeline_htn;

void use(const std::optional<timeline_htn::model::Model>& model, const mission::Findings& findings) {
  if (!model) {
    ASSERT_GT(findings.errors(), 0U);
    for (const auto& finding : findings.all()) ASSERT_FALSE(finding.file.empty()) << finding.what;
    return;
  }
  ASSERT_TRUE(usable(check(*model)));
}

class FuzzTimelineModels : public testing::Test {
 protected:
  FuzzTimelineModels()
      : folder_(fs::temp_directory_path() / ("roci-fuzz-timeline-models-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::copy(ROCI_SOURCE_DIR "/tests/missions/greenhouse", folder_, fs::copy_options::recursive);
  }
  ~FuzzTimelineModels() override { fs::remove_all(folder_); }

  template <typename Damage>
  void damage_each(int count, const Damage& damage) {
    for (const char* name : {"problem.yaml", "domain.yaml", "behaviours.yaml"}) {
      const std::string whole = read_bytes(folder_ / name);
      for (int round = 0; round < rounds(count); ++round) {
        const std::string text = damage(whole, random_);
        write_bytes(folder_ / name, text);
        mission::Findings findings;
        ASSERT_NO_FATAL_FAILURE(
            use(timeline_htn::reading::load_model({folder_ / "problem.yaml"}, findings), findings))
            << name << ":\n"
            << text;
        ASSERT_NO_FATAL_FAILURE(use_as_one_text(findings.errors() == 0)) << name << ":\n" << text;
      }
      write_bytes(folder_ / name, whole);
    }
  }

  // As a mission sends it: what is sound as files is so as one text, and the other way round.
  void use_as_one_text(bool sound) const {
    mission::Findings findings;
    std::optional<timeline_htn::model::Model> model;
    try {
      const auto name = mission::Entry::parse("model: problem.yaml\n", (folder_ / "mission.yaml").string());
      model =
          timeline_htn::reading::parse_model({{"model", mission::model_text(name.at("model"))}}, findings);
    } catch (const mission::FileError& error) {
      findings.add(error.what());
    }
    ASSERT_NO_FATAL_FAILURE(use(model, findings));
    ASSERT_EQ(model.has_value(), sound);
  }

  fs::path folder_;
  std::mt19937_64 random_{17};
};

TEST_F(FuzzTimelineModels, ADamagedFileIsTakenOrRefusedWithItsPlace) {
  damage_each(120, [](const std::string& whole, std::mt19937_64& random) { return damage(whole, random); });
}

TEST_F(FuzzTimelineModels, DamagedBytesAreTakenOrRefusedWithTheirPlace) {
  damage_each(120, [](const std::string& whole, std::mt19937_64& random) { return damaged(whole, random); });
}

}  // namespace
}  // namespace roci::fuzz
