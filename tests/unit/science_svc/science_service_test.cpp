#include "science_svc/science_service.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <fstream>

#include "services/publisher.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::science {
namespace {

using namespace std::chrono_literals;
namespace topics = services::topics;

// A mission of one flat pixel map, whose detector finds something in every image.
class ScienceService : public testing::Test {
 protected:
  void SetUp() override {
    const auto* test = testing::UnitTest::GetInstance()->current_test_info();
    settings_.mission =
        std::filesystem::path(testing::TempDir()) / (std::string("roci_science_") + test->name());
    std::filesystem::create_directories(settings_.mission / "scenarios");
    std::ofstream(settings_.mission / "mission.yaml")
        << "site: site.yaml\nscience: {threshold: 0, offset_m: 12}\n";
    std::ofstream(settings_.mission / "site.yaml")
        << "image: rocks.pgm\nresolution: 100\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
           "free_thresh: 0.2\n";
    std::ofstream(settings_.mission / "rocks.pgm") << "P2\n2 2\n255\n255 255\n255 255\n";
    std::ofstream(settings_.mission / "scenarios" / "nominal.yaml") << "duration_s: 100\n";
  }
  void TearDown() override { std::filesystem::remove_all(settings_.mission); }

  // Publishes the products at 1 s, 2 s, ... and returns the goals that were raised.
  std::vector<v1::Goal> goals_of(const std::vector<v1::DataProduct>& products) {
    services::SimRun run({"master", "science_svc"});
    services::Node& master = run.add("master");
    const auto service = make_service(run.add("science_svc"), settings_);
    const auto publisher = services::advertise(master, topics::data_product);
    std::vector<v1::Goal> goals;
    services::subscribe(master, topics::goal, [&](const v1::Goal& goal) { goals.push_back(goal); });
    auto at = 1s;
    for (const v1::DataProduct& product : products) {
      master.at(at, [&publisher, product] { publisher.write(product); });
      at += 1s;
    }
    master.at(at, [&master] { master.stop(); });
    run.run();
    return goals;
  }

  static v1::DataProduct image(const std::string& id, double x, double y) {
    v1::DataProduct out;
    out.id(id);
    out.product_kind("image");
    out.fate(v1::PRODUCT_STORED);
    out.x_m(x);
    out.y_m(y);
    return out;
  }

  services::RunSettings settings_;
};

TEST_F(ScienceService, RaisesAnOpportunisticGoalNearTheImage) {
  const auto goals = goals_of({image("one", 50, 60)});
  ASSERT_EQ(goals.size(), 1u);
  EXPECT_EQ(goals[0].issuer(), "science_svc");
  EXPECT_EQ(goals[0].id(), "find-1");
  EXPECT_EQ(goals[0].goal_kind(), "photo");
  EXPECT_EQ(goals[0].importance(), v1::GOAL_OPPORTUNISTIC);
  ASSERT_EQ(goals[0].arguments().size(), 2u);
  EXPECT_EQ(goals[0].arguments()[0].name(), "x");
  const double x = std::stod(goals[0].arguments()[0].value());
  const double y = std::stod(goals[0].arguments()[1].value());
  EXPECT_NEAR(std::hypot(x - 50, y - 60), 12, 1);
}

TEST_F(ScienceService, LooksAtStoredImagesOnly) {
  v1::DataProduct sent = image("one", 50, 60);
  sent.fate(v1::PRODUCT_SENT);
  v1::DataProduct spectrum = image("two", 100, 60);
  spectrum.product_kind("spectrum");
  EXPECT_TRUE(goals_of({sent, spectrum}).empty());
}

TEST_F(ScienceService, IsSilentWhereTheScenarioSaysSo) {
  std::ofstream(settings_.mission / "scenarios" / "nominal.yaml") << "science: {enabled: false}\n";
  EXPECT_TRUE(goals_of({image("one", 50, 60)}).empty());
}

}  // namespace
}  // namespace roci::science
