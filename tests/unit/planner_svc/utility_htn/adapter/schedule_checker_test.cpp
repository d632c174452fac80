// What an engine tells of downlinks, damaged in each way that the independent checker knows.
#include "planner_svc/utility_htn/checking/schedule_checker.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <functional>

#include "tests/unit/planner_svc/utility_htn/adapter/outlook_fixture.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

using engine::DownlinkSchedule, engine::ScheduledDownlink;
using ::testing::Contains, ::testing::HasSubstr, ::testing::IsEmpty, ::testing::Not;

struct Damage {
  const char* name;
  std::function<void(DownlinkSchedule&)> done;
  const char* fault;
};

void PrintTo(const Damage& damage, std::ostream* out) { *out << damage.name; }

class DamagedSchedules : public OutlookTest, public ::testing::WithParamInterface<Damage> {};

// The first downlink that carries something.
ScheduledDownlink& loaded(DownlinkSchedule& schedule) {
  return *std::ranges::find_if(schedule.downlinks,
                               [](const ScheduledDownlink& one) { return !one.products.empty(); });
}

TEST_P(DamagedSchedules, AreFound) {
  start();
  engine::DataProduct soon = picture("soon", "nobody#1.0");
  soon.tier = engine::DataTier::decisional;
  engine::StepInputs inputs;
  inputs.products = {soon, picture("old", "nobody#1.0")};
  inputs.now = now_ += temporal::seconds(60);
  step(inputs);
  ASSERT_GE(schedule_.downlinks.size(), 3U);
  ASSERT_EQ(loaded(schedule_).products.front().id, "soon");
  engine::StepOutput told;
  told.schedule = schedule_;
  GetParam().done(*told.schedule);
  EXPECT_THAT(checker_.faults(network_, inputs, told), Contains(HasSubstr(GetParam().fault)));
}

const Damage kDamages[] = {
    {"ADownlinkMissing", [](DownlinkSchedule& s) { s.downlinks.pop_back(); },
     "is planned and not in the schedule"},
    {"ADownlinkOfNothing", [](DownlinkSchedule& s) { s.downlinks.front().activity = "dig_near#1.0"; },
     "'dig_near#1.0' is no downlink of the plan"},
    {"AProductForgotten",
     [](DownlinkSchedule& s) { loaded(s).products.erase(loaded(s).products.begin()); },
     "product 'soon' waits on board and stands nowhere"},
    {"APromiseForgotten",
     [](DownlinkSchedule& s) {
       for (ScheduledDownlink& one : s.downlinks)
         std::erase_if(one.products, [](const auto& product) { return !product.exists; });
     },
     "stands in the downlinks 0 times"},
    {"AProductTwice",
     [](DownlinkSchedule& s) { s.downlinks.back().products.push_back(loaded(s).products.front()); },
     "product 'soon' stands in the downlinks twice"},
    {"AProductFromNowhere", [](DownlinkSchedule& s) { loaded(s).products.front().id = "ghost"; },
     "product 'ghost' is said to exist, and does not wait on board"},
    {"APromiseOfNobody",
     [](DownlinkSchedule& s) {
       for (ScheduledDownlink& one : s.downlinks)
         for (auto& product : one.products)
           if (!product.exists) product.id = "sample_near/dig_near/picture";
     },
     "product 'sample_near/dig_near/picture' is promised by nothing in the plan"},
    {"AnotherSize", [](DownlinkSchedule& s) { loaded(s).products.front().bytes = 901; },
     "product 'soon' has another size or tier than its owner says"},
    {"AnotherTier",
     [](DownlinkSchedule& s) { loaded(s).products.front().tier = engine::DataTier::critical; },
     "product 'soon' has another size or tier than its owner says"},
    {"AnotherSum", [](DownlinkSchedule& s) { loaded(s).bytes += 1; }, "bytes, and its products have"},
    {"TiersInAnotherOrder",
     [](DownlinkSchedule& s) { std::ranges::rotate(loaded(s).products, loaded(s).products.begin() + 1); },
     "does not send tiers in their order"},
    {"TooMuchForItsTime",
     [](DownlinkSchedule& s) {
       for (ScheduledDownlink& one : s.downlinks)
         if (&one != &loaded(s)) {
           loaded(s).products.insert(loaded(s).products.end(), one.products.begin(), one.products.end());
           one.products.clear();
         }
     },
     "would go on when Earth is no longer in view"},
    {"ALaterDownlinkWithoutAReason",
     [](DownlinkSchedule& s) {
       s.downlinks.back().products.push_back(loaded(s).products.front());
       loaded(s).products.erase(loaded(s).products.begin());
     },
     "does not go with the first window after its creation"},
    {"LeftOutWithoutAReason",
     [](DownlinkSchedule& s) {
       s.left_out.push_back({loaded(s).products.front(), ""});
       loaded(s).products.erase(loaded(s).products.begin());
     },
     "product 'soon' is left out without a reason"},
    {"LeftOutAlthoughThereIsRoom",
     [](DownlinkSchedule& s) {
       s.left_out.push_back({loaded(s).products.back(), "no room"});
       loaded(s).products.pop_back();
     },
     "has room for it"},
    {"LateWithoutADownlink",
     [](DownlinkSchedule& s) { s.late.push_back({{"ghost", true, 1, {}}, "full"}); },
     "product 'ghost' is late, but goes with no downlink"},
};

INSTANTIATE_TEST_SUITE_P(Each, DamagedSchedules, ::testing::ValuesIn(kDamages),
                         [](const auto& test) { return std::string(test.param.name); });

// An executive that was started again may know an older version than the newest, which the engine changes then.
TEST_F(OutlookTest, TheCheckerFollowsAChangeOfAnOlderVersion) {
  start();
  engine::StepInputs inputs;
  inputs.now = now_;
  engine::StepOutput newer, from_the_older;
  temporal::FlexiblePlan next = plan_;
  ++next.version;
  newer.delta = temporal::difference(plan_, next);
  ++next.version;
  from_the_older.delta = temporal::difference(plan_, next);
  EXPECT_THAT(checker_.faults(network_, inputs, newer), IsEmpty());
  EXPECT_THAT(checker_.faults(network_, inputs, from_the_older), IsEmpty());
  from_the_older.delta->from_version = 77;
  EXPECT_THAT(checker_.faults(network_, inputs, from_the_older), Contains(HasSubstr("it changes version 77")));
}

TEST_F(OutlookTest, OnlyDataOfWhatWasPlannedBeforeMayLoseTheirDownlink) {
  network_ = imaging_lander();
  UtilityEngine engine({"utility_htn", "lander", "", ""}, imaging_lander(), {});
  engine::StepInputs inputs;
  inputs.goals.push_back(whole_mission());
  inputs.observations.push_back({"lander.battery", *battery_, now_});
  inputs.receipt = engine::Receipt{0, 0, "", "", true};
  inputs.now = now_;
  engine::StepOutput told = engine.step(inputs);
  ASSERT_TRUE(told.delta && told.schedule);
  auto& products = loaded(*told.schedule).products;
  told.schedule->left_out.push_back({products.front(), "the windows are full"});
  products.erase(products.begin());
  checking::ScheduleChecker checker;
  EXPECT_THAT(checker.faults(network_, inputs, told), Contains(HasSubstr("is planned although its product")));
  told.delta.reset();
  EXPECT_THAT(checker.faults(network_, inputs, told), Not(Contains(HasSubstr("is planned although"))));
}

// The limit of a downlink is for 20 s of its 300 s.
TEST_F(OutlookTest, TheCheckerKnowsTheLimitOfOneDownlink) {
  model::Network network = imaging_lander();
  start(network);
  network.parameters.push_back({"downlink_limit_j", 2000, 0, 1e9});
  engine::StepInputs inputs;
  inputs.now = now_;
  engine::StepOutput told;
  told.schedule = schedule_;
  EXPECT_THAT(checker_.faults(network, inputs, told),
              Contains(HasSubstr("takes more than the energy limit of one downlink")));
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
