// Owners of external functions: every tuple gets exactly one outcome, whatever is asked.
#include "services/wire/function_wire.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>

namespace roci::services::wire {
namespace {

using testing::ElementsAre;

const std::vector<OwnedFunction> kFunctions{{"one", {"thing"}, "s"}, {"two", {"thing", "thing"}, "J"}};

v1::PlanObject object(const std::string& name, const std::string& value) {
  v1::PlanObject object;
  object.name(name);
  v1::Property property;
  property.name("x");
  property.value(value);
  object.properties().push_back(property);
  return object;
}

v1::FunctionRequest request(const std::string& function, std::uint32_t arity,
                            std::vector<std::uint32_t> tuples) {
  v1::FunctionBatch batch;
  batch.function(function);
  batch.arity(arity);
  batch.tuples(std::move(tuples));
  v1::FunctionRequest out;
  out.objects({object("a", "1.5"), object("b", "2")});
  out.batches({batch});
  return out;
}

FunctionResult sum(const OwnedFunction&, std::span<const v1::PlanObject* const> objects,
                   v1::FunctionAccuracy) {
  double total = 0;
  for (const v1::PlanObject* object : objects) total += *finite_property(*object, "x");
  return {v1::FUNCTION_VALUE, total};
}

v1::FunctionValues answer(const v1::FunctionRequest& request, const std::stop_token& stop = {}) {
  return answer_batches(request, 7, kFunctions, sum, stop).results().at(0);
}

TEST(FunctionWire, AnswersTuplesInOrder) {
  const auto values = answer(request("two", 2, {0, 1, 1, 1}));
  EXPECT_THAT(values.numbers(), ElementsAre(3.5, 4.0));
  EXPECT_THAT(values.outcomes(), ElementsAre(v1::FUNCTION_VALUE, v1::FUNCTION_VALUE));
}

TEST(FunctionWire, SaysWhatIsWrongWithATuple) {
  EXPECT_THAT(answer(request("one", 1, {0, 2})).outcomes(),
              ElementsAre(v1::FUNCTION_VALUE, v1::FUNCTION_UNKNOWN_OBJECT));
  EXPECT_THAT(answer(request("two", 1, {0})).outcomes(), ElementsAre(v1::FUNCTION_WRONG_ARITY));
  EXPECT_THAT(answer(request("two", 2, {0, 1, 0})).outcomes(),
              ElementsAre(v1::FUNCTION_VALUE, v1::FUNCTION_WRONG_ARITY));
  EXPECT_THAT(answer(request("three", 1, {0})).outcomes(), ElementsAre(v1::FUNCTION_UNKNOWN_FUNCTION));
}

TEST(FunctionWire, OffersItsAccuraciesAndAnswersWithTheExactValueForAnother) {
  const std::vector<OwnedFunction> functions{
      {"plain", {"thing"}, "s"},
      {"both", {"thing"}, "s", {v1::ACCURACY_EXACT, v1::ACCURACY_LOWER_BOUND}, {"rover.battery"}}};
  const v1::FunctionOffer offer = function_offer("m", "o", 1, functions);
  EXPECT_TRUE(offer.functions().at(0).accuracies().empty());
  EXPECT_THAT(offer.functions().at(1).accuracies(),
              ElementsAre(v1::ACCURACY_EXACT, v1::ACCURACY_LOWER_BOUND));
  EXPECT_THAT(offer.functions().at(1).depends_on(), ElementsAre("rover.battery"));

  const Evaluator tell = [](const OwnedFunction&, std::span<const v1::PlanObject* const>,
                            v1::FunctionAccuracy accuracy) -> FunctionResult {
    return {v1::FUNCTION_VALUE, accuracy == v1::ACCURACY_LOWER_BOUND ? 1.0 : 2.0};
  };
  const auto asked = [&](const char* name, v1::FunctionAccuracy accuracy) {
    v1::FunctionRequest one = request(name, 1, {0});
    one.batches()[0].accuracy(accuracy);
    return answer_batches(one, 7, functions, tell, {}).results().at(0);
  };
  EXPECT_EQ(asked("both", v1::ACCURACY_LOWER_BOUND).accuracy(), v1::ACCURACY_LOWER_BOUND);
  EXPECT_THAT(asked("both", v1::ACCURACY_LOWER_BOUND).numbers(), ElementsAre(1.0));
  EXPECT_EQ(asked("plain", v1::ACCURACY_LOWER_BOUND).accuracy(), v1::ACCURACY_EXACT);
  EXPECT_THAT(asked("plain", v1::ACCURACY_LOWER_BOUND).numbers(), ElementsAre(2.0));
  EXPECT_EQ(asked("both", v1::ACCURACY_ESTIMATE).accuracy(), v1::ACCURACY_EXACT);
}

TEST(FunctionWire, AStoppedOwnerFailsTheRest) {
  std::stop_source stop;
  stop.request_stop();
  EXPECT_THAT(answer(request("one", 1, {0, 1}), stop.get_token()).outcomes(),
              ElementsAre(v1::FUNCTION_FAILED, v1::FUNCTION_FAILED));
}

TEST(FunctionWire, NoRequestIsTooStrange) {
  std::mt19937_64 random(5);
  for (int round = 0; round < 2000; ++round) {
    std::vector<std::uint32_t> tuples(random() % 7);
    for (auto& index : tuples) index = static_cast<std::uint32_t>(random() % 4);
    const auto arity = static_cast<std::uint32_t>(random() % 4);
    const auto values = answer(request(random() % 2 == 0 ? "one" : "two", arity, tuples));
    const std::size_t width = std::max<std::size_t>(arity, 1);
    EXPECT_EQ(values.outcomes().size(), (tuples.size() + width - 1) / width);
    EXPECT_EQ(values.numbers().size(), values.outcomes().size());
  }
}

TEST(FunctionWire, OnlyFiniteNumbersAreNumbers) {
  EXPECT_EQ(finite_property(object("a", "-1.25e1"), "x"), -12.5);
  for (const char* text : {"", "x", "1.5m", "nan", "inf", " 1"}) {
    EXPECT_EQ(finite_property(object("a", text), "x"), std::nullopt) << text;
  }
  EXPECT_EQ(finite_property(object("a", "1"), "y"), std::nullopt);
}

}  // namespace
}  // namespace roci::services::wire
