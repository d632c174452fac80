#include "sim_svc/scenario/stimuli_file.hpp"

#include <algorithm>
#include <array>
#include <fstream>
#include <set>
#include <utility>

#include "sim_svc/scenario/body_stimuli_file.hpp"
#include "sim_svc/scenario/file_values.hpp"
#include "sim_svc/scenario/orders_file.hpp"
#include "sim_svc/scenario/soil_file.hpp"

namespace roci::sim::scenario {

using mission::Entry;
using setup::RobotEntry;
using setup::Roster;
using temporal::Time;
using world::ComponentFault;
using world::ComponentMishap;
using world::Disturbance;
using world::GenerationLoss;
using world::HollowSuccess;
using world::JointWear;
using world::ModuleFailure;
using world::RockFall;
using world::SlotBlock;
using world::TrenchCollapse;

namespace {

Time time_or_none(const Entry& map, std::string_view key) {
  const auto entry = map.find(key);
  return entry ? time_of(*entry) : Time{};
}

Importance read_importance(const Entry& entry) {
  const std::string text = entry.text();
  if (text == "hard") return Importance::hard;
  if (text == "optional") return Importance::optional;
  if (text == "opportunistic") return Importance::opportunistic;
  entry.fail("unknown importance '" + text + "'; known: hard, optional, opportunistic");
}

std::vector<double> read_utility(const Entry& entry) {
  if (!entry.is_sequence()) return {entry.number()};
  std::vector<double> out;
  for (const Entry& score : entry.items()) out.push_back(score.number());
  return out;
}

GoalStimulus read_goal(const Entry& entry) {
  entry.allow_only({"issuer", "id", "kind", "robot", "importance", "utility", "priority", "preferred_s",
                    "opens_s", "closes_s", "arguments"});
  GoalStimulus goal;
  goal.entry = entry;
  goal.issuer = entry.text_or("issuer", "ground");
  goal.id = entry.at("id").text();
  goal.kind = entry.at("kind").text();
  if (const auto importance = entry.find("importance")) goal.importance = read_importance(*importance);
  goal.robot = entry.text_or("robot", "");
  if (const auto utility = entry.find("utility")) goal.utility = read_utility(*utility);
  if (const auto preferred = entry.find("preferred_s")) goal.preferred = time_of(*preferred);
  if (const auto priority = entry.find("priority"))
    goal.priority = static_cast<std::int32_t>(priority->integer());
  goal.opens = time_or_none(entry, "opens_s");
  goal.closes = time_or_none(entry, "closes_s");
  if (const auto arguments = entry.find("arguments")) {
    for (const auto& [name, value] : arguments->fields()) goal.arguments.emplace_back(name, value.text());
  }
  return goal;
}

RecallStimulus read_recall(const Entry& entry) {
  entry.allow_only({"issuer", "id"});
  return {entry.text_or("issuer", "ground"), entry.at("id").text()};
}

NetworkStimulus read_network(const Entry& entry) {
  entry.allow_only({"issuer", "id", "robot", "file"});
  NetworkStimulus out{
      entry.text_or("issuer", "ground"), entry.at("id").text(), entry.text_or("robot", ""), {}, {}, 0};
  const Entry file = entry.at("file");
  std::ifstream in(file.resolve(file.text()), std::ios::binary);
  if (!in) file.fail("'" + file.text() + "' cannot be read; name a file that roci-network pack has written");
  constexpr std::size_t kMost = 15U << 20U;  // what the wire carries
  out.content.resize(kMost + 1);
  in.read(out.content.data(), static_cast<std::streamsize>(out.content.size()));
  out.content.resize(static_cast<std::size_t>(in.gcount()));
  if (out.content.size() > kMost) file.fail("more than " + std::to_string(kMost) + " bytes; make it smaller");
  if (out.content.empty()) file.fail("the file is empty; name one that roci-network pack has written");
  return out;
}

NetworkStimulus read_parameter(const Entry& entry) {
  entry.allow_only({"issuer", "id", "robot", "name", "value"});
  return {entry.text_or("issuer", "ground"), entry.at("id").text(),     entry.text_or("robot", ""), {},
          entry.at("name").text(),           entry.at("value").number()};
}

HazardStimulus read_hazard(const Entry& entry) {
  entry.allow_only({"id", "x", "y", "radius"});
  return {entry.at("id").text(),
          {entry.at("x").number(), entry.at("y").number(), at_least(entry.at("radius"), 0.01)}};
}

ComponentFault read_fault(const Entry& entry, const RobotEntry& robot, Time at) {
  entry.allow_only({"component", "for_s", "slow", "stuck"});
  const setup::ComponentEntry& component = component_of(entry.at("component"), robot);
  ComponentFault out{robot.name, component.name, at + time_of(entry.at("for_s"))};
  const auto slow = entry.find("slow");
  const bool stuck = entry.truth_or("stuck", false);
  if (slow && stuck) entry.fail("it is either slow or stuck; keep one");
  if (slow) out.pace = 1 / at_least(*slow, 1);
  if (stuck) out.pace = 0;
  if (out.pace && !component.can_be_slowed)
    entry.fail("a component of type " + component.type +
               " can only fail; drop slow and stuck, or model it as a task");
  return out;
}

double share_of(const Entry& entry) {
  const double value = at_least(entry, 0);
  if (value > 1) entry.fail("is a share, from 0 to 1; correct the number");
  return value;
}

ModuleFailure read_module_failure(const Entry& entry) {
  entry.allow_only({"module"});
  return {entry.at("module").text()};
}

SlotBlock read_slot_block(const Entry& entry) {
  entry.allow_only({"slot"});
  return {entry.at("slot").text()};
}

JointWear read_joint_wear(const Entry& entry) {
  entry.allow_only({"joint", "friction", "growth"});
  JointWear out{entry.at("joint").text()};
  const auto friction = entry.find("friction"), growth = entry.find("growth");
  if (!friction && !growth) entry.fail("the joint would stay as it is; add friction or growth");
  if (friction) out.friction = at_least(*friction, 0);
  if (growth) out.growth = at_least(*growth, 0);
  return out;
}

TrenchCollapse read_collapse(const Entry& entry) {
  entry.allow_only({"site", "share"});
  TrenchCollapse out{entry.at("site").text()};
  if (const auto share = entry.find("share")) out.share = share_of(*share);
  return out;
}

HollowSuccess read_hollow(const Entry& entry, const RobotEntry& robot) {
  entry.allow_only({"component", "command"});
  const setup::ComponentEntry& component = component_of(entry.at("component"), robot);
  if (!component.can_be_hollow)
    entry.fail("a component of type " + component.type +
               " cannot succeed without effect; drop the stimulus, or model it as a task");
  return {robot.name, component.name, entry.at("command").text()};
}

GenerationLoss read_eclipse(const Entry& entry, const RobotEntry& robot, Time at) {
  entry.allow_only({"generation", "for_s"});
  if (!robot.power || !has_panel(*robot.power))
    entry.fail("'" + robot.name + "' has no panel that could give less; drop the stimulus");
  return {robot.name, share_of(entry.at("generation")), at + time_of(entry.at("for_s"))};
}

// Returns the robot whom the stimulus concerns.
const RobotEntry& robot_of(const Entry& entry, const Roster& roster) {
  const auto name = entry.find("robot");
  if (const RobotEntry* robot = robot_named(roster, name ? name->text() : "")) return *robot;
  if (name) {
    name->fail("no robot '" + name->text() +
               "'; known: " + setup::known_names(name->text(), robot_names(roster)));
  }
  entry.fail("there are several robots; say which with robot: one of " +
             setup::known_names("", robot_names(roster)));
}

using What = decltype(Stimulus::what);

// Is whom a stimulus concerns, and when; `entry` is the whole of it.
struct Occasion {
  const Entry& entry;
  const Roster& roster;
  Time at;

  const RobotEntry& robot() const { return robot_of(entry, roster); }
  Disturbance mishap(world::Mishap what) const {
    return Disturbance{ComponentMishap{robot().name, std::move(what)}};
  }
};

// Is a word that a stimulus may hold, and who reads what stands there.
struct StimulusKind {
  const char* word;
  What (*read)(const Entry& entry, const Occasion& occasion);
};

constexpr std::array kStimulusKinds{
    StimulusKind{"goal", [](const Entry& entry, const Occasion&) -> What { return read_goal(entry); }},
    StimulusKind{"recall", [](const Entry& entry, const Occasion&) -> What { return read_recall(entry); }},
    StimulusKind{"hazard", [](const Entry& entry, const Occasion&) -> What { return read_hazard(entry); }},
    StimulusKind{"fault",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return Disturbance{read_fault(entry, occasion.robot(), occasion.at)};
                 }},
    StimulusKind{
        "rock",
        [](const Entry& entry, const Occasion&) -> What { return Disturbance{RockFall{read_rock(entry)}}; }},
    StimulusKind{"battery_loss_j",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return Disturbance{read_energy_loss(entry, occasion.robot())};
                 }},
    StimulusKind{"battery_to_j",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return Disturbance{read_energy_drop(entry, occasion.robot())};
                 }},
    StimulusKind{"module_fails",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return occasion.mishap(read_module_failure(entry));
                 }},
    StimulusKind{"slot_blocked",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return occasion.mishap(read_slot_block(entry));
                 }},
    StimulusKind{"slow_joint",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return occasion.mishap(read_joint_wear(entry));
                 }},
    StimulusKind{"eclipse",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return Disturbance{read_eclipse(entry, occasion.robot(), occasion.at)};
                 }},
    StimulusKind{"network", [](const Entry& entry, const Occasion&) -> What { return read_network(entry); }},
    StimulusKind{"parameter",
                 [](const Entry& entry, const Occasion&) -> What { return read_parameter(entry); }},
    StimulusKind{"trench_collapses",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return occasion.mishap(read_collapse(entry));
                 }},
    StimulusKind{"hollow",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return Disturbance{read_hollow(entry, occasion.robot())};
                 }},
    StimulusKind{"surroundings",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return Disturbance{read_surroundings_change(entry, occasion.roster)};
                 }},
    StimulusKind{"heat",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return Disturbance{read_sudden_heat(entry, occasion.robot())};
                 }},
    StimulusKind{"rate",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return Disturbance{read_rate_change(entry, occasion.robot())};
                 }},
    StimulusKind{"blocked_view",
                 [](const Entry& entry, const Occasion& occasion) -> What {
                   return Disturbance{read_view_block(entry, occasion.at)};
                 }},
    StimulusKind{"set", [](const Entry& entry, const Occasion&) -> What { return read_set(entry); }},
    StimulusKind{"order", [](const Entry& entry, const Occasion&) -> What { return read_order(entry); }},
    StimulusKind{"soil",
                 [](const Entry& entry, const Occasion&) -> What {
                   return Disturbance{world::SoilChange{read_soil_area(entry)}};
                 }},
};

std::string stimulus_kinds() {
  std::string out;
  for (const StimulusKind& kind : kStimulusKinds) out += (out.empty() ? "" : ", ") + std::string(kind.word);
  return out;
}

Stimulus read_stimulus(const Entry& entry, const Roster& roster) {
  entry.allow_only({"at_s",         "robot",        "goal",         "recall",
                    "hazard",       "fault",        "rock",         "battery_loss_j",
                    "battery_to_j", "module_fails", "slot_blocked", "slow_joint",
                    "eclipse",      "network",      "parameter",    "trench_collapses",
                    "hollow",       "surroundings", "heat",         "set",
                    "rate",         "blocked_view", "soil",         "order"});
  const std::size_t frame = entry.find("robot") ? 2 : 1;
  if (entry.fields().size() != frame + 1)
    entry.fail("a stimulus is at_s (and robot) and one of " + stimulus_kinds() + "; split it into several");
  Stimulus out;
  out.at = time_of(entry.at("at_s"));
  for (const StimulusKind& kind : kStimulusKinds) {
    out.entry = entry.find(kind.word);
    if (!out.entry) continue;
    out.what = kind.read(*out.entry, {entry, roster, out.at});
    break;
  }
  return out;
}

}  // namespace

std::vector<Stimulus> read_stimuli(const Entry& list, temporal::Duration duration, const Roster& roster) {
  std::vector<Stimulus> out;
  std::set<std::pair<std::string, std::string>> uploaded;
  list.each([&](const Entry& item) {
    const Stimulus& stimulus = out.emplace_back(read_stimulus(item, roster));
    if (stimulus.at > duration)
      item.at("at_s").complain("lies after the end of the run; raise duration_s or drop it");
    if (const auto* goal = std::get_if<GoalStimulus>(&stimulus.what))
      uploaded.emplace(goal->issuer, goal->id);
    const auto* recall = std::get_if<RecallStimulus>(&stimulus.what);
    if (recall && !uploaded.contains({recall->issuer, recall->id})) {
      item.fail("recalls '" + recall->id + "', which no stimulus above uploads; correct the id or the order");
    }
  });
  std::stable_sort(out.begin(), out.end(), [](const Stimulus& a, const Stimulus& b) { return a.at < b.at; });
  return out;
}

}  // namespace roci::sim::scenario
