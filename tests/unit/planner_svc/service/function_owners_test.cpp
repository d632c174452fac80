// Who is asked for the values of a module that several services offer.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <map>

#include "planner_svc/function_owners_service.hpp"
#include "planner_svc/limits.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::planner {
namespace {

using ::testing::AllOf;
using ::testing::HasSubstr;

// "owner" or "owner of robot", each offering module roads.
FunctionOffers offers_of(const std::vector<std::pair<std::string, std::string>>& owners) {
  FunctionOffers offers;
  for (const auto& [owner, robot] : owners) {
    v1::FunctionOffer& offer = offers[{"roads", owner}];
    offer.module_name("roads");
    offer.owner(owner);
    offer.header().robot(robot);
  }
  return offers;
}

std::string chosen(const FunctionOffers& offers, const std::string& robot, const std::string& dead = "") {
  const OwnerChoice choice =
      choose_owner(offers, "roads", robot, [&](const std::string& owner) { return owner != dead; });
  return choice.offer != nullptr ? choice.offer->owner() : choice.reason;
}

TEST(FunctionOwnersChoice, TheRobotsOwnOwnerGoesBeforeOneForAll) {
  const FunctionOffers offers = offers_of({{"roads_a", "primary"}, {"roads_b", "scout"}, {"roads", ""}});
  EXPECT_EQ(chosen(offers, "primary"), "roads_a");
  EXPECT_EQ(chosen(offers, "scout"), "roads_b");
  EXPECT_EQ(chosen(offers, "third"), "roads");
}

TEST(FunctionOwnersChoice, WhoHasNoRobotTakesTheOnlyOwner) {
  EXPECT_EQ(chosen(offers_of({{"roads_a", "primary"}}), ""), "roads_a");
}

TEST(FunctionOwnersChoice, AnotherRobotsOwnerIsNotAsked) {
  EXPECT_THAT(chosen(offers_of({{"roads_a", "primary"}}), "scout"),
              AllOf(HasSubstr("for robot 'scout'"), HasSubstr("roads_a of primary")));
}

TEST(FunctionOwnersChoice, AnAmbiguityIsRefusedInWords) {
  EXPECT_THAT(chosen(offers_of({{"roads_a", "primary"}, {"roads_b", "scout"}}), ""),
              AllOf(HasSubstr("several services offer module 'roads'"),
                    HasSubstr("roads_a of primary, roads_b of scout"), HasSubstr("'services'")));
  EXPECT_THAT(chosen(offers_of({{"roads_a", ""}, {"roads_b", ""}}), "scout"), HasSubstr("roads_a, roads_b"));
}

TEST(FunctionOwnersChoice, WhoIsGoneCountsOnlyWhereThereIsNoOther) {
  EXPECT_EQ(chosen(offers_of({{"roads_a", ""}, {"roads_b", ""}}), "", "roads_a"), "roads_b");
  EXPECT_EQ(chosen(offers_of({{"roads_a", ""}}), "", "roads_a"), "roads_a") << "its loss is told by the call";
}

TEST(FunctionOwnersChoice, NoOfferIsToldWithWhatThereIs) {
  EXPECT_EQ(choose_owner(offers_of({{"roads_a", ""}}), "raods", "", {}).reason,
            "no service offers module 'raods'; offered are: roads");
  EXPECT_EQ(choose_owner({}, "roads", "", {}).reason, "no service offers module 'roads'; offered are: none");
}

// An owner that does not offer the accuracy is asked for exact values, and one that does gets what was asked.
TEST(FunctionOwnersAccuracy, WhatIsNotOfferedIsAskedForExactly) {
  using namespace std::chrono_literals;
  services::SimRun run({"sim_svc", "planner_svc"});
  services::Node& owner = run.add("sim_svc");
  services::Node& planner = run.add("planner_svc");
  const auto offers = services::advertise(owner, services::topics::function_offer);
  FunctionOwners owners(planner, 1s);
  std::map<std::string, v1::FunctionAccuracy> asked;
  services::serve(owner, services::topics::function_call,
                  [&](const v1::FunctionRequest& request, services::Responder<v1::FunctionReply> responder) {
                    const v1::FunctionBatch& batch = request.batches()[0];
                    asked[batch.function()] = batch.accuracy();
                    EXPECT_EQ(request.state().size(), 1U);
                    EXPECT_EQ(request.state()[0].name(), "(battery)");
                    EXPECT_EQ(request.state()[0].held().number(), 20);
                    responder.reply(v1::FunctionReply());
                  });
  owner.at(1s, [&] {
    v1::FunctionOffer offer;
    offer.module_name("roads");
    offer.owner("sim_svc");
    offer.functions().resize(2);
    offer.functions()[0].name("exact_alone");
    offer.functions()[1].name("both");
    offer.functions()[1].accuracies({v1::ACCURACY_EXACT, v1::ACCURACY_LOWER_BOUND});
    offers.write(offer);
  });
  const auto ask = [&](const std::string& function) {
    engine::FunctionCall call{"roads", function, {"a"}};
    call.accuracy = temporal::FunctionAccuracy::lower_bound;
    call.state = {{"(battery)", 20, "battery-20"}};
    owners.ask({call}, {}, [](const std::vector<engine::FunctionValue>&) {});
  };
  planner.at(2s, [&] { ask("exact_alone"); });
  planner.at(4s, [&] { ask("both"); });
  owner.at(10s, [&] { owner.stop(); });
  run.run();
  EXPECT_EQ(asked["exact_alone"], v1::ACCURACY_EXACT);
  EXPECT_EQ(asked["both"], v1::ACCURACY_LOWER_BOUND);
}

// Who offers more than there is room for is not asked; who was there before is, and may say something newer.
TEST(FunctionOwnersBounds, OffersAreBounded) {
  using namespace std::chrono_literals;
  services::SimRun run({"sim_svc", "planner_svc"});
  services::Node& owner = run.add("sim_svc");
  services::Node& planner = run.add("planner_svc");
  const auto offers = services::advertise(owner, services::topics::function_offer);
  FunctionOwners owners(planner, 1s);
  owner.at(1s, [&] {
    for (std::size_t i = 0; i < kOffers + 5; ++i) {
      v1::FunctionOffer offer;
      offer.module_name("module-" + std::to_string(1000 + i));
      offer.owner("sim_svc");
      offers.write(offer);
    }
  });
  std::map<std::size_t, std::string> reasons;
  planner.at(2s, [&] {
    for (const std::size_t i : {kOffers - 1, kOffers}) {
      engine::FunctionCall call;
      call.module = "module-" + std::to_string(1000 + i);
      owners.ask({call}, {}, [&reasons, i](const std::vector<engine::FunctionValue>& values) {
        reasons[i] = values.at(0).reason;
      });
    }
  });
  owner.at(10s, [&] { owner.stop(); });
  run.run();
  EXPECT_THAT(reasons[kOffers], HasSubstr("no service offers module 'module-1256'"));
  EXPECT_THAT(reasons[kOffers - 1], ::testing::Not(HasSubstr("no service offers")));
}

}  // namespace
}  // namespace roci::planner
