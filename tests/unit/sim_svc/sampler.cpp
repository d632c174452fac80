#include "tests/unit/sim_svc/sampler.hpp"

namespace roci::sim {

using temporal::seconds;

Sampler::Sampler() {
  power.capacity_j = 100e6;
  power.idle_w = 0;
  components::SamplingSite site;
  site.ice.specific_energy_j_m3 = 1e9;
  site.ice.layer_noise = 0;
  site.joints = arm.rest = arm.inlet = arm.dump = {0, 0, 0, 0, 0};
  arm.sites = {{"0", site}, {"1", site}};
  arm.targets = {"0", "1"};
  arm.cutter = {100, 0.01};  // 1e9 J/m³ × 0.01 m² × 0.1 m at 100 W are 10,000 s
  arm.cutter_efficiency = 0.5;
  arm.specific_energy_j_m3 = 1e9;
  arm.duration_noise = arm.power_noise = 0;
  laboratory.duration_noise = laboratory.power_noise = 0;
  using components::Signature;
  laboratory.signatures = {{"0_0", Signature::positive},
                           {"0_1", Signature::negative},
                           {"1_0", Signature::negative},
                           {"1_1", Signature::drawn}};
}

void Sampler::make_cold() {
  arm.zone = "arm";
  laboratory.zone = "laboratory";
  thermal.emplace();
  thermal->surroundings_k = 100;
  for (const char* name : {"arm", "laboratory"}) {
    world::ZoneParameters zone;
    zone.name = name;
    zone.start_k = zone.keep_k = 150;
    zone.work_k = 220;
    zone.capacity_j_k = 20000;
    zone.loss_w_k = 0.5;
    zone.heater_w = 200;
    thermal->zones.push_back(zone);
  }
}

world::WorldSetup Sampler::build() const {
  world::RobotSetup robot;
  robot.name = "lander";
  robot.power = world::PowerSetup{power, battery_j};
  robot.thermal = thermal;
  robot.data_bytes = data_bytes;
  robot.components = {part<components::SamplingArm>("arm", "sampling_arm", arm),
                      part<components::Laboratory>("laboratory", "laboratory", laboratory)};
  return {{}, {}, {robot}};
}

SamplerFlight::SamplerFlight(const Sampler& sampler, std::uint64_t seed) : Flight(sampler.build(), seed) {}

std::string SamplerFlight::start(const std::string& component, const std::string& command,
                                 const std::map<std::string, std::string>& arguments) {
  newest = command + std::to_string(++count_);
  now += seconds(1);
  this->command(now, execute(newest, component, command, arguments));
  return newest;
}

std::string SamplerFlight::run(const std::string& component, const std::string& command,
                               const std::map<std::string, std::string>& arguments) {
  start(component, command, arguments);
  for (int i = 0; i < 1440 && stage(newest) == services::owner::Stage::accepted; ++i) pass(60);
  return code(newest);
}

std::string SamplerFlight::arm(const std::string& command,
                               const std::map<std::string, std::string>& arguments) {
  return run("arm", command, arguments);
}

std::string SamplerFlight::analyze(const std::string& site, const std::string& target,
                                   const std::string& form) {
  return run("laboratory", "analyze", {{"site", site}, {"target", target}, {"form", form}});
}

void SamplerFlight::pass(double s) {
  now += seconds(s);
  advance(now);
}

double SamplerFlight::seconds_taken() const {
  return temporal::to_seconds(last_ack(newest).value().status.results.duration.value());
}

double SamplerFlight::joules_taken() const {
  return last_ack(newest).value().status.results.energy_j.value();
}

}  // namespace roci::sim
