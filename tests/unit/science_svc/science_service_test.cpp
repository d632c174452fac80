#include "science_svc/science_service.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>

#include "science_svc/detector.hpp"
#include "science_svc/limits.hpp"
#include "services/publisher.hpp"
#include "tests/unit/science_svc/photos.hpp"
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
        << "site: site.yaml\nscience: {threshold: 0.75, merge_m: 2}\n";
    std::ofstream(settings_.mission / "site.yaml")
        << "image: rocks.pgm\nresolution: 100\norigin: [0, 0, 0]\nnegate: 0\noccupied_thresh: 0.65\n"
           "free_thresh: 0.2\n";
    std::ofstream(settings_.mission / "rocks.pgm") << "P2\n2 2\n255\n255 255\n255 255\n";
    std::ofstream(settings_.mission / "scenarios" / "nominal.yaml") << "duration_s: 100\n";
  }
  void TearDown() override { std::filesystem::remove_all(settings_.mission); }

  struct Said {
    std::vector<v1::Goal> goals;
    std::vector<v1::DataProduct> crops;
    std::vector<v1::Event> events;
  };
  std::vector<v1::Goal> goals_of(const std::vector<v1::DataProduct>& products) {
    return said_to(products).goals;
  }

  // Publishes the products at 1 s, 2 s, ... , what became of goals before, and returns what the service says.
  Said said_to(const std::vector<v1::DataProduct>& products, const std::vector<v1::GoalStatus>& before = {}) {
    services::SimRun run({"master", "science_svc"});
    services::Node& master = run.add("master");
    const auto service = make_service(run.add("science_svc"), settings_);
    const auto publisher = services::advertise(master, topics::data_product);
    const auto statuses = services::advertise(master, topics::goal_status);
    Said said;
    services::subscribe(master, topics::goal, [&](const v1::Goal& goal) { said.goals.push_back(goal); });
    services::subscribe(master, topics::event, [&](const v1::Event& event) { said.events.push_back(event); });
    services::subscribe(master, topics::data_product, [&](const v1::DataProduct& product) {
      if (product.product_kind() == "crop") said.crops.push_back(product);
    });
    auto at = 1s;
    for (const v1::GoalStatus& status : before) {
      master.at(at, [&statuses, status] { statuses.write(status); });
      at += 1s;
    }
    for (const v1::DataProduct& product : products) {
      master.at(at, [&publisher, product] { publisher.write(product); });
      at += 1s;
    }
    master.at(at, [&master] { master.stop(); });
    run.run();
    return said;
  }

  // Plain ground that was seen before anything else.
  static std::vector<v1::DataProduct> plain() {
    std::vector<v1::DataProduct> out;
    for (std::uint64_t i = 0; i < 4; ++i)
      out.push_back(image("plain-" + std::to_string(i), 150, 150, made_ground(i)));
    for (v1::DataProduct& one : out)
      one.created_us(-1);  // older than the service: they teach it, and raise nothing
    return out;
  }
  static std::vector<v1::DataProduct> plain_and(std::vector<v1::DataProduct> more) {
    std::vector<v1::DataProduct> out = plain();
    out.insert(out.end(), more.begin(), more.end());
    return out;
  }

  static v1::DataProduct image(const std::string& id, double x, double y,
                               const terrain::GreyImage& pixels = made_ground(77, 12)) {
    v1::DataProduct out;
    const std::string file = terrain::to_pgm(pixels, "");
    out.preview({file.begin(), file.end()});
    out.id(id);
    out.product_kind("image");
    out.fate(v1::PRODUCT_STORED);
    out.x_m(x);
    out.y_m(y);
    return out;
  }

  services::RunSettings settings_;
};

TEST_F(ScienceService, RaisesAnOpportunisticGoalWhereTheImageShowsIt) {
  const Said said = said_to(plain_and({image("one", 50, 60)}));
  ASSERT_EQ(said.goals.size(), 1u);
  const v1::Goal& goal = said.goals[0];
  EXPECT_EQ(goal.issuer(), "science_svc");
  EXPECT_EQ(goal.goal_kind(), "photo");
  EXPECT_EQ(goal.importance(), v1::GOAL_OPPORTUNISTIC);
  ASSERT_EQ(goal.arguments().size(), 2u);
  EXPECT_EQ(goal.arguments()[0].name(), "x");
  const terrain::Point place{std::stod(goal.arguments()[0].value()), std::stod(goal.arguments()[1].value())};
  const auto truth = ground_at({}, {}, {{50, 60}, 0}, kWidth, kHeight, 48, 38, 50);
  EXPECT_LT(terrain::distance(place, *truth), 1.5);
  EXPECT_EQ(goal.id(), find_id(place));
  ASSERT_EQ(goal.utility().size(), 1u);
  EXPECT_GE(goal.utility()[0], 0.75);
}

TEST_F(ScienceService, PublishesACropOfWhatItFound) {
  const Said said = said_to(plain_and({image("one", 50, 60)}));
  ASSERT_EQ(said.crops.size(), 1u);
  const v1::DataProduct& crop = said.crops[0];
  EXPECT_EQ(crop.source(), "one");
  EXPECT_EQ(crop.id(), "crop-" + said.goals.at(0).id());
  EXPECT_EQ(crop.bytes(), crop.preview().size());
  const terrain::GreyImage pixels = terrain::parse_pgm(
      {reinterpret_cast<const char*>(crop.preview().data()), crop.preview().size()}, "crop");
  EXPECT_LT(pixels.width, kWidth);
}

TEST_F(ScienceService, LooksAtPanoramasToo) {
  v1::DataProduct view = image("view", 50, 60);
  view.product_kind("panorama");
  EXPECT_EQ(goals_of(plain_and({view})).size(), 1u);
}

TEST_F(ScienceService, LooksAtStoredImagesOnly) {
  v1::DataProduct sent = image("one", 50, 60);
  sent.fate(v1::PRODUCT_SENT);
  v1::DataProduct spectrum = image("two", 100, 60);
  spectrum.product_kind("spectrum");
  EXPECT_TRUE(goals_of(plain_and({sent, spectrum})).empty());
}

TEST_F(ScienceService, IsSilentWhereTheScenarioSaysSo) {
  std::ofstream(settings_.mission / "scenarios" / "nominal.yaml") << "science: {enabled: false}\n";
  EXPECT_TRUE(goals_of(plain_and({image("one", 50, 60)})).empty());
}

TEST_F(ScienceService, AnUnreadableImageIsAnEventAndTheNextOneIsLookedAt) {
  v1::DataProduct broken = image("broken", 50, 60);
  broken.preview().resize(100);
  v1::DataProduct empty = image("empty", 50, 60);
  empty.preview({});
  const Said said = said_to(plain_and({broken, empty, image("one", 50, 60)}));
  std::vector<std::string> told;
  for (const v1::Event& event : said.events)
    if (event.code() == "image.unreadable") told.push_back(event.text());
  ASSERT_EQ(told.size(), 2u);
  EXPECT_NE(told[0].find("broken:"), std::string::npos) << told[0];
  EXPECT_NE(told[1].find("empty: the image has no pixels"), std::string::npos) << told[1];
  EXPECT_EQ(said.goals.size(), 1u);
}

TEST_F(ScienceService, TellsOfABoundedNumberOfUnreadableImages) {
  v1::DataProduct broken = image("broken", 50, 60);
  broken.preview().resize(100);
  std::vector<v1::DataProduct> products;
  for (std::size_t i = 0; i < kUnreadableTold + 5; ++i) {
    products.push_back(broken);
    products.back().id("broken-" + std::to_string(i));
  }
  products.push_back(image("one", 50, 60));
  const Said said = said_to(plain_and(products));
  const auto told = std::ranges::count_if(
      said.events, [](const v1::Event& event) { return event.code() == "image.unreadable"; });
  EXPECT_EQ(told, static_cast<std::ptrdiff_t>(kUnreadableTold));
  EXPECT_EQ(said.goals.size(), 1u) << "what can be read is looked at";
}

// What an earlier process of this service has raised is known from what became of it.
TEST_F(ScienceService, RaisesNothingAgainAfterARestart) {
  const auto first = goals_of(plain_and({image("one", 50, 60)}));
  ASSERT_EQ(first.size(), 1u);
  v1::GoalStatus status;
  status.executive("exec_svc");
  status.issuer("science_svc");
  status.id(first[0].id());
  EXPECT_TRUE(said_to(plain_and({image("another", 50.5, 60)}), {status}).goals.empty());
  status.issuer("ground");
  EXPECT_EQ(said_to(plain_and({image("another", 50.5, 60)}), {status}).goals.size(), 1u)
      << "that goal is not its own";
}

TEST_F(ScienceService, LearnsFromImagesThatAreOlderThanItselfAndRaisesNothing) {
  v1::DataProduct old = image("one", 50, 60);
  old.created_us(-1);
  EXPECT_TRUE(goals_of(plain_and({old})).empty());
}

TEST_F(ScienceService, NeedsNoMap) {
  std::ofstream(settings_.mission / "mission.yaml") << "science: {threshold: 0.75}\n";
  EXPECT_EQ(goals_of(plain_and({image("one", -500, 60)})).size(), 1u);
}

}  // namespace
}  // namespace roci::science
