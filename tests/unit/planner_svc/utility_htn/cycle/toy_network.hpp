// A small lander: it digs, images and sends on 1,000 J, in words short enough for tests.
#pragma once

#include <string>

#include "planner_svc/utility_htn/model/network.hpp"

namespace roci::planner::utility_htn::testing {

using temporal::timelines::Kind;

inline constexpr temporal::timelines::Index kBattery = 0, kSite = 1, kArm = 2, kHealth = 3;

/// Requests `sample` (dig, image, send), `view` (image, send) and `idle`; the template `probe` is nobody's request.
/// Digging takes 200 J, imaging 50 J, sending 100 J; `idle` runs 1 W for 300 s.
inline model::Network toy_network() {
  using namespace std::chrono_literals;
  model::Network out;
  out.name = "toy";
  out.ranks = {"science"};
  out.batches = {"first", "second"};
  out.parameters = {{"dig_s", 100, 10, 400}, {"dig_w", 2, 0, 10}};
  out.timelines = {{"battery", Kind::cumulative_rate, {}, 1000, 0, 1000, true},
                   {"site", Kind::state, {"closed", "open"}},
                   {"arm", Kind::atomic, {}, 0, 0, 1, false},
                   {"health", Kind::state, {"works", "broken"}}};
  out.timelines[kSite].reported = false;
  const auto add = [&](const std::string& id, double seconds, double watts) {
    model::Task task;
    task.id = task.name = id;
    task.duration = {seconds};
    if (watts != 0)
      task.impacts.push_back({kBattery, temporal::ImpactKind::rate, temporal::ImpactWhen::during, {-watts}});
    task.is_template = true;
    task.control.wait_timeout = 1000s;
    out.tasks.push_back(task);
    return static_cast<model::TaskIndex>(out.tasks.size() - 1);
  };
  const auto dig = add("dig", 0, 0);
  out.tasks[dig].duration = {0, 0, 1};
  out.tasks[dig].impacts = {{kBattery, temporal::ImpactKind::rate, temporal::ImpactWhen::during, {0, 1, -1}},
                            {kSite, temporal::ImpactKind::assign, temporal::ImpactWhen::at_end, {1}},
                            {kArm, temporal::ImpactKind::delta, temporal::ImpactWhen::during, {1}}};
  out.tasks[dig].constraints = {{.timeline = kHealth, .states = 1}};
  const auto image = add("image", 50, 1);
  out.tasks[image].impacts.push_back({kArm, temporal::ImpactKind::delta, temporal::ImpactWhen::during, {1}});
  const auto send = add("send", 20, 5);
  const auto request = [&](const std::string& id, double utility, std::vector<model::TaskIndex> steps) {
    model::Task task;
    task.id = task.name = id;
    model::Decomposition way{"plain", {}, {}};
    for (const auto step : steps) way.subtasks.push_back({step});
    task.decompositions = {way};
    out.tasks.push_back(task);
    // The worth of a request lies in what it sends.
    model::Task sent = out.tasks[send];
    sent.id = sent.name = "send_" + id;
    sent.utility = {{utility}};
    out.tasks.back().decompositions.front().subtasks.back().task =
        static_cast<model::TaskIndex>(out.tasks.size());
    out.tasks.push_back(sent);
  };
  request("sample", 10, {dig, image, send});
  request("view", 2, {image, send});
  const auto idle = add("idle", 300, 1);
  out.tasks[idle].is_template = false;
  out.tasks[idle].utility = {{0.1}};
  out.cycle = {10s, 5s, 30s, temporal::no_bound, 3600s};
  return out;
}

/// Returns the task of that id.
inline model::TaskIndex task_named(const model::Network& network, const std::string& id) {
  for (model::TaskIndex i = 0; i < network.tasks.size(); ++i)
    if (network.tasks[i].id == id) return i;
  return static_cast<model::TaskIndex>(network.tasks.size());
}

}  // namespace roci::planner::utility_htn::testing
