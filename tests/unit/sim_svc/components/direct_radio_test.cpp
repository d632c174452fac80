#include "sim_svc/components/direct_radio.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::components {

using services::owner::Stage;
using temporal::seconds;
using temporal::State;
using temporal::Time;
using testing::HasSubstr;
using world::Fate;
using world::Product;

namespace {

// Makes a product of the kind and size that it is told, at once.
class Maker final : public world::Component {
 public:
  std::vector<world::CommandForm> commands() const override { return {{"make", {"kind", "bytes", "tier"}}}; }
  State state() const override { return {"idle", {}}; }
  bool busy() const override { return end_.has_value(); }
  world::Ending begin(const world::Task& task, Time now, world::Surroundings& around) override {
    Product product;
    product.kind = task.arguments.at("kind");
    product.bytes = std::stoull(task.arguments.at("bytes"));
    product.tier = *world::tier_named(task.arguments.at("tier"));
    product.source = task.key.activity;
    product.created = now;
    around.out.push_back(*around.body.data->add(std::move(product)));
    end_ = now;
    return std::nullopt;
  }
  std::optional<Time> next_change() const override { return end_; }
  world::Ending finish(world::Surroundings&) override {
    end_.reset();
    return std::nullopt;
  }
  void halt(Time, world::Surroundings&) override { end_.reset(); }

 private:
  std::optional<Time> end_{};
};

// Earth in view in [1000, 5000) and from 9000 s on; 100 bytes a second, 2000 s of light time, no noise.
struct Lander {
  Lander() {
    radio.prepare_s = 300;
    radio.rate_byte_s = 100;
    radio.rate_noise = radio.duration_noise = 0;
    radio.light_time_s = 2000;
  }
  DirectRadioSettings radio;
  world::PowerSetup power{{1e6, 0}, 500000};
  std::optional<world::ThermalParameters> thermal{};

  world::WorldSetup build() const {
    world::RobotSetup robot;
    robot.name = "lander";
    robot.power = power;
    robot.thermal = thermal;
    robot.data_bytes = 1e6;
    robot.components = {part<DirectRadio>("radio", "direct_radio", radio),
                        {"maker", "maker", [](world::RandomStream) { return std::make_unique<Maker>(); }}};
    return {
        {}, {{"earth.window", {{seconds(1000), seconds(5000)}, {seconds(9000), seconds(99000)}}}}, {robot}};
  }
};

struct Link : Flight {
  explicit Link(const Lander& lander = {}) : Flight(lander.build()) {}

  void make(Time at, const std::string& kind, int bytes, const std::string& tier) {
    command(at, execute("make-" + std::to_string(++made_), "maker", "make",
                        {{"kind", kind}, {"bytes", std::to_string(bytes)}, {"tier", tier}}));
  }
  void send(Time at, const std::string& activity, std::optional<Time> latest_end = std::nullopt) {
    auto request = execute(activity, "radio", "send");
    request.latest_end = latest_end;
    command(at, request);
  }
  void schedule(Time at, const std::string& activity, std::vector<std::string> products) {
    append(said, world.heed(at, {"", {{activity, std::move(products)}}}));
  }
  // The products of that fate, in the order in which they came to it.
  std::vector<std::string> ids(Fate fate) const {
    std::vector<std::string> out;
    for (const Product& one : products_in(said))
      if (one.fate == fate) out.push_back(one.id);
    return out;
  }
  double number(const std::string& activity, const std::string& name) const {
    return std::get<double>(last_ack(activity)->status.results.values.at(name));
  }

 private:
  int made_ = 0;
};

using Ids = std::vector<std::string>;

TEST(DirectRadio, SendsByTierThenByAgeWhereNobodyPlans) {
  Link run;
  run.make(seconds(1), "raw", 1000, "residual");
  run.make(seconds(2), "panorama", 2000, "mandatory");
  run.make(seconds(3), "summary", 500, "decisional");
  run.make(seconds(4), "alarm", 100, "critical");
  run.make(seconds(5), "quakes", 400, "mandatory");
  run.send(seconds(1100), "d");
  EXPECT_EQ(run.state("lander.radio"), (State{"sending", {}}));
  run.advance(seconds(1200));
  EXPECT_EQ(run.ids(Fate::sent), (Ids{"alarm", "summary", "panorama", "quakes", "raw"}));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  EXPECT_EQ(run.time_of("d"), seconds(1140)) << "4000 bytes at 100 a second";
  EXPECT_EQ(run.number("d", "products"), 5);
  EXPECT_EQ(run.number("d", "bytes"), 4000);
  EXPECT_EQ(run.state("lander.radio"), (State{"idle", {}}));
}

TEST(DirectRadio, WhatIsSentIsReceivedOneLightTimeLater) {
  Link run;
  run.make(seconds(1), "summary", 500, "decisional");
  run.send(seconds(1100), "d");
  run.advance(seconds(1105 + 1999));
  EXPECT_EQ(run.ids(Fate::received), Ids{});
  run.advance(seconds(1105 + 2000));
  EXPECT_EQ(run.ids(Fate::received), (Ids{"summary"}));
}

TEST(DirectRadio, WhatIsOnItsWayOutlivesTheProcess) {
  Link run;
  run.make(seconds(1), "summary", 500, "decisional");
  run.make(seconds(1), "raw", 900, "residual");
  run.schedule(seconds(1), "d", {"summary"});
  run.send(seconds(1100), "d");
  run.advance(seconds(1200));
  world::World next(Lander{}.build(), 1);
  next.restore(run.world.memory());
  Link after;
  after.said = next.advance(seconds(4000));
  EXPECT_EQ(after.ids(Fate::received), (Ids{"summary"}));
}

TEST(DirectRadio, FollowsTheScheduleAndEndsWithIt) {
  Link run;
  run.make(seconds(1), "raw", 1000, "residual");
  run.make(seconds(2), "panorama", 2000, "mandatory");
  run.make(seconds(3), "summary", 500, "decisional");
  run.schedule(seconds(10), "d", {"raw", "sample_0/analyze/summary"});
  run.make(seconds(20), "alarm", 100, "critical");
  run.send(seconds(1100), "d");
  run.advance(seconds(1200));
  EXPECT_EQ(run.ids(Fate::sent), (Ids{"alarm", "raw", "summary"})) << "critical data never wait";
  EXPECT_EQ(run.time_of("d"), seconds(1116));
  run.send(seconds(1300), "another");
  run.advance(seconds(1400));
  EXPECT_EQ(run.ids(Fate::sent).back(), "panorama") << "nobody has planned this downlink";
}

TEST(DirectRadio, TakesTheOldestOfAPlannedKindThatNobodyElseMeans) {
  Link run;
  run.make(seconds(1), "quakes", 100, "mandatory");
  run.make(seconds(2), "quakes", 100, "mandatory");
  run.make(seconds(3), "quakes", 100, "mandatory");
  run.schedule(seconds(4), "d", {"s/park/quakes", "quakes", "s/park/quakes 2"});
  run.send(seconds(1100), "d");
  run.advance(seconds(1200));
  EXPECT_EQ(run.ids(Fate::sent), (Ids{"quakes-2", "quakes", "quakes-3"}));
}

TEST(DirectRadio, ANewScheduleIsHeededAtTheNextProduct) {
  Link run;
  run.make(seconds(1), "a", 1000, "mandatory");
  run.make(seconds(2), "b", 1000, "mandatory");
  run.schedule(seconds(3), "d", {"a", "b"});
  run.send(seconds(1100), "d");
  run.schedule(seconds(1105), "d", {"a"});
  run.advance(seconds(1200));
  EXPECT_EQ(run.ids(Fate::sent), (Ids{"a"}));
  EXPECT_EQ(run.time_of("d"), seconds(1110));
}

TEST(DirectRadio, WaitsForContactUntilItsStepMustEnd) {
  Link run;
  run.make(seconds(1), "a", 1000, "mandatory");
  run.send(seconds(100), "early", seconds(900));
  EXPECT_EQ(run.state("lander.radio"), (State{"waiting", {}}));
  run.advance(seconds(950));
  EXPECT_EQ(run.code("early"), "no-contact");
  EXPECT_EQ(run.time_of("early"), seconds(900));
  run.send(seconds(960), "d", seconds(1900));
  run.advance(seconds(1050));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  EXPECT_EQ(run.time_of("d"), seconds(1010));
}

TEST(DirectRadio, AWindowThatClosesLosesWhatWasUnderWay) {
  Link run;
  run.make(seconds(1), "a", 1000, "mandatory");
  run.make(seconds(2), "b", 1000, "mandatory");
  run.schedule(seconds(3), "d", {"a", "b"});
  run.send(seconds(4985), "d");
  run.advance(seconds(5100));
  EXPECT_EQ(run.code("d"), "contact-lost");
  EXPECT_THAT(run.last_ack("d")->status.reason, HasSubstr("'b'"));
  EXPECT_EQ(run.time_of("d"), seconds(5000));
  EXPECT_EQ(run.ids(Fate::sent), (Ids{"a"})) << "what was sent stays sent";
  run.send(seconds(9100), "e");
  run.advance(seconds(9200));
  EXPECT_EQ(run.ids(Fate::sent), (Ids{"a", "b"}));
}

TEST(DirectRadio, AStepThatEndsLeavesTheRest) {
  Link run;
  run.make(seconds(1), "a", 1000, "mandatory");
  run.make(seconds(2), "b", 1000, "mandatory");
  run.send(seconds(1100), "free", seconds(1115));
  run.advance(seconds(1200));
  EXPECT_EQ(run.stage("free"), Stage::completed) << "nobody has promised b";
  EXPECT_EQ(run.time_of("free"), seconds(1115));
  run.make(seconds(1201), "c", 1000, "mandatory");
  run.schedule(seconds(1202), "d", {"b", "c"});
  run.send(seconds(1300), "d", seconds(1315));
  run.advance(seconds(1400));
  EXPECT_EQ(run.code("d"), "out-of-time");
  EXPECT_EQ(run.ids(Fate::sent), (Ids{"a", "b"}));
}

TEST(DirectRadio, ASessionWithoutAPlanHasItsLength) {
  Lander lander;
  lander.radio.session_s = 15;
  Link run(lander);
  run.make(seconds(1), "a", 1000, "mandatory");
  run.make(seconds(2), "b", 1000, "mandatory");
  run.send(seconds(1100), "d");
  run.advance(seconds(1200));
  EXPECT_EQ(run.time_of("d"), seconds(1115));
  EXPECT_EQ(run.ids(Fate::sent), (Ids{"a"}));
}

TEST(DirectRadio, WithNothingToSendItIsDoneInContact) {
  Link run;
  run.send(seconds(500), "d");
  run.advance(seconds(1100));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  EXPECT_EQ(run.time_of("d"), seconds(1000));
}

TEST(DirectRadio, ReceivesInContact) {
  Link run;
  run.command(seconds(1100), execute("u", "radio", "receive"));
  run.advance(seconds(1200));
  EXPECT_EQ(run.state("lander.radio"), (State{"receiving", {}}));
  run.advance(seconds(3000));
  EXPECT_EQ(run.time_of("u"), seconds(2900));
  run.command(seconds(4000), execute("v", "radio", "receive"));
  run.advance(seconds(6000));
  EXPECT_EQ(run.code("v"), "contact-lost");
  EXPECT_EQ(run.time_of("v"), seconds(5000));
}

TEST(DirectRadio, ASlowerLinkHoldsForWhatIsUnderWay) {
  Link run;
  run.make(seconds(1), "a", 1000, "mandatory");
  run.send(seconds(1100), "d");
  run.disturb(seconds(1105), world::RateChange{"lander", "radio", 0.1});
  run.advance(seconds(1200));
  EXPECT_EQ(run.time_of("d"), seconds(1155)) << "500 bytes at 100 and 500 at 10 a second";
}

TEST(DirectRadio, AnObjectBeforeTheAntennaCutsItOffAndContactComesLater) {
  Link run;
  run.make(seconds(1), "a", 1000, "mandatory");
  run.send(seconds(1100), "d");
  run.disturb(seconds(1105), world::ViewBlock{"earth.window", seconds(3000)});
  EXPECT_EQ(run.code("d"), "contact-lost");
  EXPECT_EQ(run.time_of("d"), seconds(1105));
  EXPECT_EQ(last_value(run.said, "earth.window"), temporal::Value{false});
  run.send(seconds(1200), "e");
  run.advance(seconds(3100));
  EXPECT_EQ(run.time_of("e"), seconds(3010));
}

TEST(DirectRadio, AHollowDownlinkSendsNothing) {
  Link run;
  run.make(seconds(1), "a", 1000, "mandatory");
  run.disturb(seconds(2), world::HollowSuccess{"lander", "radio", "send"});
  run.send(seconds(1100), "d");
  run.advance(seconds(1200));
  EXPECT_EQ(run.stage("d"), Stage::completed);
  EXPECT_EQ(run.number("d", "products"), 1) << "as it believes";
  EXPECT_EQ(run.ids(Fate::sent), Ids{});
  run.send(seconds(1300), "e");
  run.advance(seconds(1400));
  EXPECT_EQ(run.ids(Fate::sent), (Ids{"a"}));
}

TEST(DirectRadio, AnEmptyBatteryLeavesTheRestBehind) {
  Lander lander;
  lander.power = {{1e6, 0}, 120 * 15 + 1};
  Link run(lander);
  run.make(seconds(1), "a", 1000, "mandatory");
  run.make(seconds(2), "b", 1000, "mandatory");
  run.send(seconds(1100), "d");
  run.advance(seconds(4000));
  EXPECT_EQ(run.code("d"), "battery-flat");
  EXPECT_EQ(run.ids(Fate::left_behind), (Ids{"b"}));
  EXPECT_EQ(run.ids(Fate::received), (Ids{"a"})) << "what was on its way arrives";
}

// A zone of 20 kJ/K and 0.5 W/K at 150 K, in surroundings of 100 K; 220 K to work.
Lander cold() {
  Lander out;
  out.radio.zone = "dish";
  out.radio.waste_share = 0;
  out.power = {{1e8, 0}, 5e7};
  out.thermal.emplace();
  out.thermal->zones = {{"dish", 20000, 0.5, 100, 150, 220}};
  return out;
}

TEST(DirectRadio, IsWarmedBeforeItWorksAndPaysForIt) {
  Link run(cold());
  const double warming_s = 40000 * std::log(150.0 / 80);  // to 120 of 200 K above the surroundings, from 50
  run.command(seconds(10), execute("p", "radio", "prepare"));
  run.advance(seconds(40000));
  EXPECT_EQ(run.stage("p"), Stage::completed);
  EXPECT_NEAR(temporal::to_seconds(run.time_of("p")), 10 + warming_s + 300, 1e-3);
  const double joules = run.last_ack("p")->status.results.energy_j.value();
  EXPECT_NEAR(joules, warming_s * (100 + 10) + 300 * (60 + 60), 1)
      << "heater and electronics, then holding 220 K";
  const double later = last_number(run.said, "lander.heat.dish");
  EXPECT_LT(later, 220) << "it cools when nobody holds it";
}

TEST(DirectRadio, WhereItsHeaterIsTooWeakItFails) {
  Lander lander = cold();
  lander.thermal->zones[0].heater_w = 50;
  Link run(lander);
  run.command(seconds(10), execute("p", "radio", "prepare"));
  EXPECT_EQ(run.code("p"), "too-cold");
  auto bounded = execute("q", "radio", "prepare");
  bounded.latest_end = seconds(500);
  run.command(seconds(20), bounded);
  run.advance(seconds(600));
  EXPECT_EQ(run.code("q"), "too-cold");
  EXPECT_EQ(run.time_of("q"), seconds(500));
}

TEST(DirectRadio, SuddenHeatMakesItReadyAtOnceAndColdLater) {
  Link run(cold());
  run.command(seconds(10), execute("p", "radio", "prepare"));
  run.disturb(seconds(20), world::SuddenHeat{"lander", "dish", 5e6});
  run.advance(seconds(1000));
  EXPECT_EQ(run.time_of("p"), seconds(320));
  Link other(cold());
  other.command(seconds(10), execute("p", "radio", "prepare"));
  other.disturb(seconds(20), world::SurroundingsChange{85});
  other.advance(seconds(60000));
  EXPECT_GT(other.time_of("p"), seconds(10 + 300 + 40000 * std::log(150.0 / 80) + 1000));
}

TEST(DirectRadio, AStopLetsTheZoneCool) {
  Link run(cold());
  run.command(seconds(10), execute("p", "radio", "prepare"));
  run.command(seconds(1000), execute("s", "radio", "stop"));
  EXPECT_EQ(run.stage("p"), Stage::cancelled);
  run.advance(seconds(1100));
  const double then = last_number(run.said, "lander.heat.dish");
  run.advance(seconds(9000));
  EXPECT_LT(last_number(run.said, "lander.heat.dish"), then);
}

// Downlinks under disturbances are the same, however often the world is asked.
TEST(DirectRadio, SlicingDoesNotChangeIt) {
  const auto fly = [](double step_s) {
    Lander lander = cold();
    lander.radio.rate_noise = lander.radio.duration_noise = 0.1;
    lander.radio.waste_share = 0.4;
    Link run(lander);
    for (int i = 0; i < 30; ++i)
      run.make(seconds(1 + i), "p", 9000 + 100 * i, i % 3 ? "mandatory" : "decisional");
    const auto go = [&](double until) {
      for (double t = temporal::to_seconds(run.world.memory().at) + step_s; t < until; t += step_s)
        run.advance(seconds(t));
    };
    run.send(seconds(40), "a", seconds(30000));
    go(9500);
    run.disturb(seconds(9500), world::RateChange{"lander", "radio", 0.7});
    go(26000);
    run.disturb(seconds(26000), world::SurroundingsChange{95});
    run.send(seconds(26001), "b");
    go(40000);
    run.advance(seconds(50000));
    return products_in(run.said);
  };
  const auto once = fly(1e6);
  EXPECT_GT(once.size(), 60u);
  EXPECT_EQ(once, fly(77.7));
  EXPECT_EQ(once, fly(1234.56));
}

}  // namespace
}  // namespace roci::sim::components
