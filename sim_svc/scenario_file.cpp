#include "sim_svc/scenario_file.hpp"

#include <algorithm>
#include <set>

#include "sim_svc/world.hpp"

namespace roci::sim {
namespace {

using mission::Entry;

double at_least(const Entry& entry, double least) {
  const double value = entry.number();
  if (value < least) entry.fail("must be at least " + std::to_string(least) + "; correct the number");
  return value;
}

Time time_of(const Entry& entry) {
  const double s = at_least(entry, 0);
  if (s > 1e9) entry.fail("lies more than 30 years ahead; times are in seconds");
  return seconds(s);
}

Time time_or_none(const Entry& map, std::string_view key) {
  const auto entry = map.find(key);
  return entry ? time_of(*entry) : Time{};
}

Rock read_rock(const Entry& entry) {
  entry.allow_only({"x", "y", "radius"});
  return {entry.at("x").number(), entry.at("y").number(), at_least(entry.at("radius"), 0.01)};
}

Importance read_importance(const Entry& entry) {
  const std::string text = entry.text();
  if (text == "hard") return Importance::hard;
  if (text == "optional") return Importance::optional;
  if (text == "opportunistic") return Importance::opportunistic;
  entry.fail("unknown importance '" + text + "'; known: hard, optional, opportunistic");
}

GoalStimulus read_goal(const Entry& entry) {
  entry.allow_only(
      {"issuer", "id", "kind", "importance", "utility", "priority", "opens_s", "closes_s", "arguments"});
  GoalStimulus goal;
  goal.issuer = entry.text_or("issuer", "ground");
  goal.id = entry.at("id").text();
  goal.kind = entry.at("kind").text();
  if (const auto importance = entry.find("importance")) goal.importance = read_importance(*importance);
  goal.utility = entry.number_or("utility", goal.utility);
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

HazardStimulus read_hazard(const Entry& entry) {
  entry.allow_only({"id", "x", "y", "radius"});
  return {entry.at("id").text(),
          {entry.at("x").number(), entry.at("y").number(), at_least(entry.at("radius"), 0.01)}};
}

ComponentFault read_fault(const Entry& entry, Time at) {
  entry.allow_only({"component", "for_s"});
  const Entry component = entry.at("component");
  if (!World::has_component(component.text())) {
    component.fail("unknown component '" + component.text() + "'; known: " + World::component_names());
  }
  return {component.text(), at + time_of(entry.at("for_s"))};
}

Stimulus read_stimulus(const Entry& entry) {
  entry.allow_only({"at_s", "goal", "recall", "hazard", "fault", "rock", "battery_loss_j"});
  if (entry.fields().size() != 2) {
    entry.fail(
        "a stimulus is at_s and one of goal, recall, hazard, fault, rock, battery_loss_j; split it into "
        "several");
  }
  Stimulus out;
  out.at = time_of(entry.at("at_s"));
  if (const auto goal = entry.find("goal")) out.what = read_goal(*goal);
  if (const auto recall = entry.find("recall")) out.what = read_recall(*recall);
  if (const auto hazard = entry.find("hazard")) out.what = read_hazard(*hazard);
  if (const auto fault = entry.find("fault")) out.what = Disturbance{read_fault(*fault, out.at)};
  if (const auto rock = entry.find("rock")) out.what = Disturbance{RockFall{read_rock(*rock)}};
  if (const auto loss = entry.find("battery_loss_j")) out.what = Disturbance{EnergyLoss{at_least(*loss, 0)}};
  return out;
}

std::vector<Stimulus> read_stimuli(const Entry& list, Duration duration) {
  std::vector<Stimulus> out;
  std::set<std::pair<std::string, std::string>> uploaded;
  for (const Entry& item : list.items()) {
    const Stimulus& stimulus = out.emplace_back(read_stimulus(item));
    if (stimulus.at > duration)
      item.at("at_s").fail("lies after the end of the run; raise duration_s or drop it");
    if (const auto* goal = std::get_if<GoalStimulus>(&stimulus.what))
      uploaded.emplace(goal->issuer, goal->id);
    const auto* recall = std::get_if<RecallStimulus>(&stimulus.what);
    if (recall && !uploaded.contains({recall->issuer, recall->id})) {
      item.fail("recalls '" + recall->id + "', which no stimulus above uploads; correct the id or the order");
    }
  }
  std::stable_sort(out.begin(), out.end(), [](const Stimulus& a, const Stimulus& b) { return a.at < b.at; });
  return out;
}

void read_start(const Entry& entry, Scenario& out) {
  entry.allow_only({"x", "y", "heading", "arm", "battery"});
  out.start = {entry.at("x").number(), entry.at("y").number(), entry.number_or("heading", 0)};
  out.arm_pose = entry.at("arm").text();
  out.battery_j = at_least(entry.at("battery"), 0);
}

void read_world(const Entry& entry, Scenario& out) {
  entry.allow_only({"slip", "image_noise", "rocks"});
  if (const auto slip = entry.find("slip")) out.slip = at_least(*slip, 0);
  if (const auto noise = entry.find("image_noise")) out.image_noise = at_least(*noise, 0);
  if (const auto rocks = entry.find("rocks")) {
    for (const Entry& rock : rocks->items()) out.rocks.push_back(read_rock(rock));
  }
}

// "code", or "code: part of the text"; a code that ends in + may come several times.
ExpectedEvent read_expected(const Entry& entry) {
  ExpectedEvent out;
  if (entry.is_mapping()) {
    const auto fields = entry.fields();
    if (fields.size() != 1) entry.fail("expected one 'code: part of the text'; split it into several");
    out.code = fields.front().first;
    out.part = fields.front().second.text();
  } else {
    out.code = entry.text();
  }
  out.repeats = out.code.ends_with('+');
  if (out.repeats) out.code.pop_back();
  if (out.code.empty()) entry.fail("expected an event's code, like goal.achieved");
  return out;
}

}  // namespace

Scenario read_scenario(const Entry& root) {
  root.allow_only({"description", "duration_s", "start", "world", "windows", "science", "stimuli", "expect"});
  Scenario out;
  out.description = root.text_or("description", "");
  out.duration = time_of(root.at("duration_s"));
  read_start(root.at("start"), out);
  if (const auto world = root.find("world")) read_world(*world, out);
  if (const auto windows = root.find("windows")) out.windows = read_windows(*windows);
  if (const auto stimuli = root.find("stimuli")) out.stimuli = read_stimuli(*stimuli, out.duration);
  if (const auto expect = root.find("expect")) {
    for (const Entry& item : expect->items()) out.expect.push_back(read_expected(item));
  }
  return out;
}

std::vector<Window> read_windows(const Entry& list) {
  std::vector<Window> out;
  for (const Entry& item : list.items()) {
    Window window{item.at("timeline").text(), {}};
    for (const Entry& pair : item.at("open").items()) {
      const auto ends = pair.items();
      if (ends.size() != 2) pair.fail("expected [opens, closes], in seconds");
      const Time opens = time_of(ends[0]);
      const Time closes = time_of(ends[1]);
      if (closes <= opens) pair.fail("closes before it opens; swap the two");
      if (!window.open.empty() && opens <= window.open.back().second) {
        pair.fail("opens before the one above has closed; sort or join them");
      }
      window.open.emplace_back(opens, closes);
    }
    out.push_back(std::move(window));
  }
  return out;
}

}  // namespace roci::sim
