#include "sim_svc/world/thermal.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/sim_svc/world_fixture.hpp"

namespace roci::sim::world {

using temporal::seconds;
using temporal::Time;
using temporal::to_seconds;

namespace {

// 20 kJ/K and 0.5 W/K: 40,000 s; 50 K above surroundings of 100 K need 25 W.
ThermalParameters one_zone() {
  ThermalParameters out;
  out.zones = {{"arm", 20000, 0.5, 100, 150, 220, 140, 300, 150}};
  return out;
}

// The same zone by small steps, with a thermostat that looks at each.
class Stepped {
 public:
  double kelvin = 150, joules = 0, surroundings = 100, waste = 0, goal = 150;
  void go(double s, double loss = 0.5) {
    constexpr double kStep = 0.05;
    for (double t = 0; t < s - kStep / 2; t += kStep) {
      const double needed = loss * (kelvin - surroundings) - waste +
                            (goal - kelvin) * 20000 / kStep;  // to be there after the step
      const double heater = std::clamp(needed, 0.0, 100.0);
      joules += heater * kStep;
      kelvin += (heater + waste - loss * (kelvin - surroundings)) * kStep / 20000;
    }
  }
};

TEST(Thermal, RestsAtTheTemperatureThatItsHeaterKeeps) {
  const Thermal body(one_zone());
  EXPECT_DOUBLE_EQ(body.temperature_k("arm", seconds(1e6)), 150);
  EXPECT_NEAR(body.heater_j("arm", seconds(10), seconds(110)), 25 * 100, 1e-9);
}

TEST(Thermal, IsReadyWhenFullPowerHasBroughtIt) {
  Thermal body(one_zone());
  EXPECT_FALSE(body.ready_at("arm", seconds(10))) << "nobody warms it";
  body.hold("arm", &body, seconds(10));
  const Time ready = body.ready_at("arm", seconds(10)).value();
  // From 50 K above the surroundings to 120 K above them, of 200 K: 40,000 s × ln(150 / 80).
  EXPECT_NEAR(to_seconds(ready), 10 + 40000 * std::log(150.0 / 80), 1e-5);
  EXPECT_LT(body.temperature_k("arm", ready - seconds(1)), 220);
  EXPECT_DOUBLE_EQ(body.temperature_k("arm", ready), 220);
  EXPECT_DOUBLE_EQ(body.temperature_k("arm", ready + seconds(5000)), 220);
  EXPECT_EQ(body.ready_at("arm", ready), ready);
  body.release("arm", &body, ready);
  EXPECT_LT(body.temperature_k("arm", ready + seconds(1000)), 220);
  EXPECT_EQ(body.heater_j("arm", ready, ready + seconds(1000)), 0) << "it is warmer than it must be kept";
}

TEST(Thermal, TwoHoldItUntilBothHaveLetGo) {
  Thermal body(one_zone());
  int a = 0, b = 0;
  body.hold("arm", &a, Time{});
  body.hold("arm", &b, Time{});
  body.release("arm", &a, seconds(100));
  EXPECT_TRUE(body.held("arm"));
  body.release("arm", &b, seconds(100));
  EXPECT_FALSE(body.held("arm"));
}

TEST(Thermal, WasteHeatSavesTheHeaterAndGoesWithWhoLeftIt) {
  Thermal body(one_zone());
  int a = 0;
  body.hold("arm", &a, Time{});
  body.set_waste("arm", &a, 30, Time{});
  EXPECT_LT(body.ready_at("arm", Time{}).value(), seconds(40000 * std::log(150.0 / 80)));
  body.release("arm", &a, Time{});
  EXPECT_NEAR(body.heater_j("arm", Time{}, seconds(100)), 2500, 1e-9);
  body.set_waste("arm", &a, 10, Time{});
  EXPECT_NEAR(body.heater_j("arm", Time{}, seconds(100)), 1500, 1e-9);
}

TEST(Thermal, FactorsMakeItWasteAndLoseOtherwise) {
  ThermalParameters parameters = one_zone();
  parameters.waste_factor = 2;
  parameters.loss_factor = 3;
  Thermal body(parameters);
  body.set_waste("arm", &body, 10, Time{});
  EXPECT_NEAR(body.heater_j("arm", Time{}, seconds(100)), (3 * 25 - 2 * 10) * 100, 1e-9);
}

TEST(Thermal, TooWeakAHeaterNeverBringsItAndItLeavesItsRange) {
  ThermalParameters parameters = one_zone();
  parameters.zones[0].heater_w = 20;
  Thermal body(parameters);
  EXPECT_TRUE(body.in_range("arm", Time{}));
  body.hold("arm", &body, Time{});
  EXPECT_FALSE(body.ready_at("arm", Time{}));
  EXPECT_NEAR(body.temperature_k("arm", seconds(1e7)), 140, 1e-6);
  body.set_surroundings(80, seconds(1e7));
  EXPECT_FALSE(body.in_range("arm", seconds(1e7 + 100)));
}

TEST(Thermal, SuddenHeatIsThereAtOnce) {
  Thermal body(one_zone());
  body.add_heat("arm", 200000, seconds(5));
  EXPECT_DOUBLE_EQ(body.temperature_k("arm", seconds(5)), 160);
  body.add_heat("arm", -400000, seconds(5));
  EXPECT_DOUBLE_EQ(body.temperature_k("arm", seconds(5)), 140);
  EXPECT_NEAR(body.heater_j("arm", seconds(5), seconds(6)), 100, 1e-9) << "the heater catches up";
}

TEST(Thermal, GoesOnFromItsMemory) {
  Thermal body(one_zone());
  body.add_heat("arm", 200000, seconds(5));
  Thermal next(one_zone());
  next.restore(body.memory(seconds(300)), seconds(300));
  EXPECT_NEAR(next.temperature_k("arm", seconds(900)), body.temperature_k("arm", seconds(900)), 1e-9);
}

// The closed form is held against an integration in small steps, over random changes.
TEST(Thermal, AgreesWithIntegration) {
  for (std::uint32_t seed = 1; seed <= 20; ++seed) {
    std::mt19937_64 engine(seed);
    const auto uniform = [&](double from, double to) {
      return from + (to - from) * static_cast<double>(engine() >> 11) * 0x1p-53;
    };
    Thermal body(one_zone());
    Stepped stepped;
    double t = 0, joules = 0;
    for (int i = 0; i < 12; ++i) {
      const Time now = seconds(t);
      switch (engine() % 4) {
        case 0:
          body.hold("arm", &body, now);
          body.set_waste("arm", &body, stepped.waste, now);
          stepped.goal = 220;
          break;
        case 1:
          body.release("arm", &body, now);
          stepped.goal = 150;
          stepped.waste = 0;
          break;
        case 2:
          stepped.waste = uniform(0, 90);
          body.set_waste("arm", &body, stepped.waste, now);
          break;
        default:
          stepped.surroundings = uniform(50, 180);
          body.set_surroundings(stepped.surroundings, now);
      }
      const double s = std::round(uniform(100, 9000));
      stepped.go(s);
      joules += body.heater_j("arm", now, seconds(t + s));
      t += s;
      ASSERT_NEAR(body.temperature_k("arm", seconds(t)), stepped.kelvin, 0.01)
          << "seed " << seed << ", " << i;
      ASSERT_NEAR(joules, stepped.joules, 1e-4 * joules + 20) << "seed " << seed << ", " << i;
    }
  }
}

// ---- a robot with heat

world::WorldSetup station(double use_factor = 1) {
  world::RobotSetup robot;
  robot.name = "station";
  robot.power = PowerSetup{{1e6, 10}, 500000};
  robot.power->parameters.use_factor = use_factor;
  robot.thermal = one_zone();
  return {{}, {}, {robot}};
}

TEST(Thermal, ARobotPaysForItsHeatersAndTellsItsTemperatures) {
  Flight run(station());
  run.advance(seconds(1000));
  EXPECT_EQ(last_number(run.said, "station.heat.arm"), 150);
  EXPECT_NEAR(last_number(run.said, "station.battery"), 500000 - (10 + 25) * 960, 1) << "told at 960 s";
}

TEST(Thermal, AllThatIsDrawnGrowsByTheUseFactor) {
  Flight run(station(1.1));
  run.advance(seconds(1000));
  EXPECT_NEAR(last_number(run.said, "station.battery"), 500000 - 1.1 * (10 + 25) * 960, 1);
}

TEST(Thermal, ItsTemperaturesOutliveTheProcess) {
  Flight run(station());
  WorldMemory memory = run.world.memory();
  EXPECT_EQ(memory.robots.at("station").temperatures_k.at("arm"), 150);
  memory.robots.at("station").temperatures_k["arm"] = 200;
  World next(station(), 1);
  next.restore(memory);
  EXPECT_EQ(last_number(next.advance(Time{}), "station.heat.arm"), 200);
}

}  // namespace
}  // namespace roci::sim::world
