#include "sim_svc/components/sampling_arm_settings.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "sim_svc/setup/roster_file.hpp"

namespace roci::sim::components {

using mission::Entry;
using setup::Settings;

namespace {

constexpr double kLeast = 1e-3;   // of what is divided by
constexpr double kDeepest = 100;  // m

ArmJoints read_joints(const Entry& entry) {
  const auto items = entry.items();
  ArmJoints out{};
  if (items.size() != out.size())
    entry.fail("expected " + std::to_string(out.size()) + " joints such as [0, 0.2, 1, -1.2, 0], in rad");
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = items[i].number();
  return out;
}

world::ColdPart read_cold_part(const Entry& entry, double command_s) {
  entry.allow_only({"capacity_j_k", "loss_w_k", "heater_w", "work_k", "usual_k"});
  world::ColdPart out;
  out.capacity_j_k = setup::number(entry, "capacity_j_k", out.capacity_j_k, 1);
  out.loss_w_k = setup::number(entry, "loss_w_k", out.loss_w_k, 1e-6);
  out.heater_w = setup::number(entry, "heater_w", out.heater_w, kLeast);
  out.work_k = setup::number(entry, "work_k", out.work_k);
  out.usual_k = setup::number(entry, "usual_k", out.usual_k);
  const auto usual = world::warming(out, out.usual_k);
  if (!usual) entry.fail("this heater never brings it to work_k; raise heater_w, or lower loss_w_k");
  if (usual->seconds > command_s)
    entry.fail("warming takes " + std::to_string(std::lround(usual->seconds)) + " s, the whole command " +
               std::to_string(std::lround(command_s)) + " s; raise heater_w, or the command's duration");
  return out;
}

// Says of each command that works for a time what it warms.
void read_warms(const Entry& entry, SamplingArmSettings& out) {
  const std::map<std::string, double> lasting{{"prepare", out.prepare_s},
                                              {"collect", out.collect_s},
                                              {"transport", out.transport_s},
                                              {"discard", out.discard_s}};
  entry.each_field([&](const std::string& command, const Entry& part) {
    const auto known = lasting.find(command);
    if (known == lasting.end())
      part.fail("'" + command +
                "' warms nothing beside the zone; known: prepare, collect, transport, discard");
    out.warms.insert_or_assign(command, read_cold_part(part, known->second));
  });
}

// Writes what the entry says of a site over what is said of it already; `usual` holds for the ice of all sites.
void read_site(const Entry& entry, SamplingSite& out, const Ice& usual) {
  entry.allow_only({"hardness", "deepest_m", "jams_per_h", "joints"});
  if (entry.find("hardness"))
    out.ice.specific_energy_j_m3 = setup::number(entry, "hardness", 1, kLeast) * usual.specific_energy_j_m3;
  if (entry.find("deepest_m")) {
    const double deepest = setup::number(entry, "deepest_m", 0, 0);
    out.ice.deepest_m = std::min(deepest, usual.deepest_m.value_or(deepest));
  }
  out.jams_per_h = setup::number(entry, "jams_per_h", out.jams_per_h, 0);
  if (const auto joints = entry.find("joints")) out.joints = read_joints(*joints);
}

// Reads the sites of mission.yaml, and writes over them what the scenario says of some.
void read_sites(Settings& in, const SamplingSite& usual, SamplingArmSettings& out) {
  const Entry mission = in.component().at("sites");
  mission.each_field([&](const std::string& name, const Entry& entry) {
    setup::check_name(name, entry);
    read_site(entry, out.sites.emplace(name, usual).first->second, usual.ice);
  });
  if (out.sites.empty())
    mission.fail("an arm without a site has nothing to dig; list one, as in sites: {\"0\": {}}");
  std::vector<std::string> known;
  for (const auto& [name, site] : out.sites) known.push_back(name);
  const Entry scenario = *in.find("sites");
  if (scenario.place() == mission.place()) return;
  scenario.each_field([&](const std::string& name, const Entry& entry) {
    const auto site = out.sites.find(name);
    if (site == out.sites.end())
      entry.fail("no site '" + name + "'; known: " + setup::known_names(name, known));
    read_site(entry, site->second, usual.ice);
  });
}

}  // namespace

SamplingArmSettings read_sampling_arm_settings(Settings& in) {
  SamplingArmSettings out;
  out.zone = in.text("zone", out.zone);
  if (const auto targets = in.find("targets")) out.targets = targets->texts();
  out.depth_m = in.number("depth_m", out.depth_m, kLeast);
  if (out.depth_m > kDeepest) in.find("depth_m")->fail("must be at most 100 m; correct the number");
  out.cutter.power_w = in.number("cutter_w", out.cutter.power_w, kLeast);
  out.cutter.area_m2 = in.number("trench_area_m2", out.cutter.area_m2, 1e-6);
  out.specific_energy_j_m3 = in.number("specific_energy_j_m3", out.specific_energy_j_m3, 1);
  out.cutter_efficiency = in.share("cutter_efficiency", out.cutter_efficiency);
  if (out.cutter_efficiency < kLeast)
    in.find("cutter_efficiency")->fail("nothing would come to the ice; give at least 0.001");
  out.give_up_s = in.number("give_up_s", out.give_up_s);
  out.prepare_s = in.number("prepare_s", out.prepare_s);
  out.collect_s = in.number("collect_s", out.collect_s);
  out.transport_s = in.number("transport_s", out.transport_s);
  out.discard_s = in.number("discard_s", out.discard_s);
  out.duration_noise = in.number("duration_noise", out.duration_noise);
  out.duration_factor = in.number("duration_factor", out.duration_factor, kLeast);
  out.arm_w = in.number("arm_w", out.arm_w);
  out.prepare_w = in.number("prepare_w", out.prepare_w);
  out.transfer_w = in.number("transfer_w", out.transfer_w);
  out.drill_w = in.number("drill_w", out.drill_w);
  out.power_noise = in.number("power_noise", out.power_noise);
  out.waste_share = in.share("waste_share", out.waste_share);
  out.joint_speed_rad_s = in.number("joint_speed_rad_s", out.joint_speed_rad_s, 1e-6);
  if (const auto warms = in.find("warms")) read_warms(*warms, out);
  if (const auto joints = in.find("rest")) out.rest = read_joints(*joints);
  if (const auto joints = in.find("inlet")) out.inlet = read_joints(*joints);
  if (const auto joints = in.find("dump")) out.dump = read_joints(*joints);
  SamplingSite usual;
  usual.ice.specific_energy_j_m3 = out.specific_energy_j_m3 * in.number("hardness", 1, kLeast);
  usual.ice.layer_noise = in.number("layer_noise", usual.ice.layer_noise);
  usual.ice.layer_m = in.number("layer_m", usual.ice.layer_m, out.depth_m / IceColumn::kMostLayers);
  if (in.find("deepest_m")) usual.ice.deepest_m = in.number("deepest_m", 0);
  usual.jams_per_h = in.number("jams_per_h", usual.jams_per_h);
  read_sites(in, usual, out);
  return out;
}

}  // namespace roci::sim::components
