// A planner that asks for lower bounds first, on every transport: what its owner is asked for, and what
// becomes of a call when the two accuracies do not fit together (R39).
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <set>

#include "services/process/domain_claim.hpp"
#include "tests/unit/planner_svc/service/road_planning.hpp"

namespace roci::planner {
namespace {

using namespace std::chrono_literals;
using namespace testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::HasSubstr;

class FunctionAccuracies : public ::testing::TestWithParam<std::pair<const char*, RoadVendors>> {
 protected:
  // The roads take 10 s, at least 6 s; from a to c it is `direct` seconds, at least `bound`.
  void fly(const std::string& functions, double bound = 6) {
    const services::process::DomainClaim domain;
    RoadPlanning planning(GetParam().second, domain.id(), true, functions);
    planning.owner_answers([&](const v1::FunctionRequest& request, auto responder) {
      if (const auto answer = answered(request, bound, planning.owner().now())) responder.reply(*answer);
    });
    planning.ask(1s, plan_request(kRoadDomain, road_problem()));
    planning.run_until(100s);
    ASSERT_EQ(planning.replies().size(), 1U) << "one answer, whatever happened";
    reply = planning.replies()[0].result.reply;
    requests = planning.requests_for_values();
    for (const v1::Event& event : planning.events()) events[event.code()].push_back(event.text());
  }

  std::optional<v1::FunctionReply> answered(const v1::FunctionRequest& request, double bound,
                                            temporal::Time now) {
    v1::FunctionReply answer = ten_seconds(request, now);
    const v1::FunctionBatch& batch = request.batches()[0];
    const bool cheap = batch.accuracy() == v1::ACCURACY_LOWER_BOUND;
    if (!cheap && silent_when_exact) return std::nullopt;
    for (std::size_t i = 0; i < batch.tuples().size(); i += 2) {
      const std::string tuple =
          request.objects()[batch.tuples()[i]].name() + request.objects()[batch.tuples()[i + 1]].name();
      double& number = answer.results()[0].numbers()[i / 2];
      if (cheap) number = 6;
      if (tuple == "ac") number = cheap ? bound : direct;
      (cheap ? bounds : exact).insert(tuple);
    }
    if (!cheap && bounds_for_exact) answer.results()[0].accuracy(v1::ACCURACY_LOWER_BOUND);
    return answer;
  }

  double direct = 15;
  bool silent_when_exact = false;
  bool bounds_for_exact = false;
  v1::PlanReply reply;
  int requests = 0;
  std::multiset<std::string> bounds, exact;  // tuples that were asked for
  std::map<std::string, std::vector<std::string>> events;
};

TEST_P(FunctionAccuracies, ExactValuesAreAskedForCandidatesAlone) {
  fly("two_accuracy");
  ASSERT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_EQ(steps_of(reply.solution()), "go a c");
  EXPECT_EQ(reply.solution().activities()[0].duration_lower_us(), 15'000'000);
  EXPECT_EQ(bounds.size(), 9U);
  // What was planned, and of the detour that looked shorter once the direct way was known as much
  // as shows that it is not.
  EXPECT_EQ(exact, (std::multiset<std::string>{"ab", "ac"}));
  EXPECT_EQ(reply.statistics().function_tuples(), 11U);
  for (const v1::FunctionValueUse& use : reply.solution().function_values())
    EXPECT_EQ(use.accuracy(), v1::ACCURACY_EXACT);
}

TEST_P(FunctionAccuracies, LazyAsksForNoBound) {
  fly("lazy");
  ASSERT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_EQ(steps_of(reply.solution()), "go a c");
  EXPECT_TRUE(bounds.empty());
  EXPECT_LT(exact.size(), 10U);
}

TEST_P(FunctionAccuracies, EagerAsksForAllExactly) {
  fly("eager");
  ASSERT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_TRUE(bounds.empty());
  EXPECT_EQ(exact.size(), 9U);
  EXPECT_EQ(requests, 1);
}

TEST_P(FunctionAccuracies, ABoundAboveTheExactValueIsToldAndTheExactOneCounts) {
  direct = 8;
  fly("two_accuracy", 11);
  ASSERT_EQ(reply.verdict_code(), v1::VERDICT_SOLVED) << reply.reason();
  EXPECT_EQ(reply.solution().activities()[0].duration_lower_us(), 8'000'000);
  EXPECT_THAT(
      events["planner.warning"],
      Contains(AllOf(HasSubstr("roads_svc gave 11 as a lower bound of (travel_time a c) of module roads"),
                     HasSubstr("and 8 as its exact value"))));
}

TEST_P(FunctionAccuracies, AnExactValueThatIsLateIsNamed) {
  silent_when_exact = true;
  fly("two_accuracy");
  EXPECT_EQ(reply.verdict_code(), v1::VERDICT_FUNCTION_UNAVAILABLE);
  EXPECT_THAT(reply.reason(),
              AllOf(HasSubstr("(travel_time a c) of module roads: late"), HasSubstr("roads_svc")));
}

TEST_P(FunctionAccuracies, ABoundWhereTheExactValueIsAskedForIsRefused) {
  bounds_for_exact = true;
  fly("two_accuracy");
  EXPECT_EQ(reply.verdict_code(), v1::VERDICT_FUNCTION_UNAVAILABLE);
  EXPECT_THAT(reply.reason(), HasSubstr("it answered with another accuracy than asked for"));
}

INSTANTIATE_TEST_SUITE_P(Transports, FunctionAccuracies, ::testing::ValuesIn(kRoadTransports),
                         [](const auto& test) { return std::string(test.param.first); });

}  // namespace
}  // namespace roci::planner
