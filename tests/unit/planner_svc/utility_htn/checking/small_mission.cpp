#include "tests/unit/planner_svc/utility_htn/checking/small_mission.hpp"

#include <algorithm>

namespace roci::planner::utility_htn::checking {

using model::Task, model::Tier;
using temporal::ImpactKind, temporal::ImpactWhen, temporal::seconds;
using temporal::timelines::Constraint, temporal::timelines::Definition, temporal::timelines::Kind,
    temporal::timelines::Phase;

namespace {

constexpr double kNo = 0;
constexpr double kYes = 1;

Task primitive(const std::string& id, double duration_s) {
  Task out;
  out.id = id;
  out.name = id;
  out.duration = {.constant = duration_s};
  return out;
}

Task sample(const std::string& id) {
  Task out;
  out.id = id;
  out.name = id;
  const auto when = [](std::uint64_t states) {
    return Constraint{.timeline = timeline::excavated, .phase = Phase::pre, .states = states};
  };
  const model::Subtask collect{.task = task::collect, .longest_gap = seconds(100)};
  out.decompositions = {
      {.name = "first",
       .when = {when(1)},
       .subtasks = {{task::excavate}, collect, {task::analyze}, {task::downlink}}},
      {.name = "next", .when = {when(2)}, .subtasks = {{task::collect}, {task::analyze}, {task::downlink}}}};
  return out;
}

Block block_of(model::TaskIndex request, std::vector<Step> steps) {
  return {.request = request, .steps = std::move(steps)};
}

Step step_at(std::uint64_t id, model::TaskIndex index, double start_s, bool committed = false) {
  return {.id = id, .task = index, .start = seconds(start_s), .committed = committed};
}

Window window(const std::string& id, double start_s) {
  return {.id = id,
          .start = seconds(start_s),
          .latest_end = seconds(start_s + 10),
          .bytes_per_s = 100,
          .power_w = 20};
}

}  // namespace

model::Network small_network() {
  model::Network out;
  out.ranks = {"mission", "default"};
  const auto state = [](const std::string& name, std::vector<std::string> states, double initial) {
    return Definition{.name = name, .kind = Kind::state, .states = std::move(states), .initial = initial};
  };
  out.timelines = {
      {.name = "battery", .kind = Kind::cumulative_rate, .initial = 1000, .lowest = 0, .highest = 1000},
      state("phase", {"landing", "surface"}, 1),
      {.name = "arm", .kind = Kind::atomic, .initial = 0, .lowest = 0, .highest = 1},
      {.name = "memory", .kind = Kind::cumulative, .initial = 0, .lowest = 0, .highest = 120},
      state("excavated_0", {"no", "yes"}, kNo)};
  for (const char* target : {"0_0", "0_1", "0_2", "1_0", "1_1"}) {
    out.timelines.push_back(
        state(std::string("signature_") + target, {"unknown", "negative", "positive"}, 0));
  }
  out.budget = timeline::battery;

  Task hotel = primitive("hotel", 1000);
  hotel.impacts = {{timeline::battery, ImpactKind::rate, ImpactWhen::during, {.constant = -0.1}}};
  Task excavate = primitive("excavate_0", 50);
  excavate.impacts = {{timeline::battery, ImpactKind::delta, ImpactWhen::at_start, {.constant = -100}},
                      {timeline::arm, ImpactKind::delta, ImpactWhen::during, {.constant = 1}},
                      {timeline::excavated, ImpactKind::assign, ImpactWhen::at_end, {.constant = kYes}}};
  Task collect = primitive("collect", 20);
  collect.impacts = {{timeline::battery, ImpactKind::delta, ImpactWhen::at_start, {.constant = -50}},
                     {timeline::arm, ImpactKind::delta, ImpactWhen::during, {.constant = 1}}};
  collect.constraints = {{.timeline = timeline::excavated, .phase = Phase::pre, .states = 2}};
  Task analyze = primitive("analyze", 30);
  analyze.impacts = {{timeline::battery, ImpactKind::rate, ImpactWhen::during, {.constant = -1}},
                     {timeline::memory, ImpactKind::delta, ImpactWhen::at_end, {.constant = 40}}};
  analyze.constraints = {{.timeline = timeline::memory, .phase = Phase::post, .highest = 100}};
  analyze.products = {{.name = "raw", .tier = Tier::mandatory, .bytes = {.constant = 400}},
                      {.name = "summary", .tier = Tier::decisional, .bytes = {.constant = 50}}};
  Task downlink = primitive("downlink", 10);
  downlink.impacts = {{timeline::memory, ImpactKind::delta, ImpactWhen::at_end, {.constant = -40}}};
  downlink.downlinks = true;
  Task panorama = primitive("panorama", 10);
  panorama.constraints = {{.timeline = timeline::phase, .phase = Phase::maintenance, .states = 2}};
  Task uplink = primitive("uplink", 5);
  uplink.fixed = true;
  uplink.preferred_start = seconds(300);
  uplink.constraints = {{.timeline = timeline::phase, .phase = Phase::maintenance, .states = 2}};
  out.tasks = {hotel,
               excavate,
               collect,
               analyze,
               downlink,
               panorama,
               uplink,
               sample("sample_0_0"),
               sample("sample_0_1"),
               sample("sample_0_2"),
               sample("sample_1_0"),
               sample("sample_1_1")};

  out.subway.most_samples = 2;
  out.subway.sites = {{.name = "site_0",
                       .value = {.constant = 0.9},
                       .targets = {{task::sample_0_0, timeline::signature_0_0, {.constant = 0.8}},
                                   {task::sample_0_1, timeline::signature_0_1, {.constant = 0.5}},
                                   {task::sample_0_2, timeline::signature_0_2, {.constant = 0.2}}}},
                      {.name = "site_1",
                       .value = {.constant = 0.4},
                       .targets = {{task::sample_1_0, timeline::signature_1_0, {.constant = 0.8}},
                                   {task::sample_1_1, timeline::signature_1_1, {.constant = 0.5}}}}};
  out.cycle.plan_end = seconds(1000);
  return out;
}

SmallMission::SmallMission() {
  plan = {block_of(task::hotel, {step_at(1, task::hotel, 0, true)}),
          block_of(task::panorama, {step_at(2, task::panorama, 40, true)}),
          block_of(task::sample_0_0, {step_at(10, task::excavate, 60), step_at(11, task::collect, 110),
                                      step_at(12, task::analyze, 130), step_at(13, task::downlink, 170)}),
          block_of(task::sample_0_1, {step_at(14, task::collect, 200), step_at(15, task::analyze, 220),
                                      step_at(16, task::downlink, 260)}),
          block_of(task::uplink, {step_at(20, task::uplink, 300)})};
  before = plan;
  downlinks.windows = {window("evening", 170), window("morning", 260)};
  const auto promised = [](const std::string& id, std::uint64_t step, const std::string& name,
                           double created_s, std::uint32_t window_index) {
    const bool raw = name == "raw";
    return Product{.id = id,
                   .tier = raw ? Tier::mandatory : Tier::decisional,
                   .bytes = raw ? std::uint64_t{400} : std::uint64_t{50},
                   .created = seconds(created_s),
                   .step = step,
                   .name = name,
                   .window = window_index};
  };
  downlinks.products = {promised("raw_a", 12, "raw", 160, 0), promised("summary_a", 12, "summary", 160, 0),
                        promised("raw_b", 15, "raw", 250, 1), promised("summary_b", 15, "summary", 250, 1),
                        Product{.id = "photo", .tier = Tier::residual, .bytes = 300, .window = 0}};
}

Block& SmallMission::block(model::TaskIndex request) {
  return *std::ranges::find(plan, request, &Block::request);
}

Step& SmallMission::step(std::uint64_t id) {
  for (Block& here : plan) {
    for (Step& step : here.steps) {
      if (step.id == id) return step;
    }
  }
  throw std::invalid_argument("no such step");
}

Product& SmallMission::product(const std::string& id) {
  return *std::ranges::find(downlinks.products, id, &Product::id);
}

std::vector<std::string> SmallMission::faults() const {
  return checking::faults({.network = network,
                           .values = values,
                           .plan = plan,
                           .before = before,
                           .broken_off = broken_off,
                           .downlinks = downlinks,
                           .observations = observations,
                           .now = seconds(30),
                           .from = seconds(60),
                           .budget = budget,
                           .closed = closed});
}

}  // namespace roci::planner::utility_htn::checking
