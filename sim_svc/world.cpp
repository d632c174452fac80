#include "sim_svc/world.hpp"

#include <algorithm>
#include <cmath>

namespace roci::sim {
namespace {

constexpr Duration kTick{1000000};  // the battery is settled at least this often
constexpr double kMillimetre = 1e-3;
constexpr double kMilliradian = 1e-3;
constexpr double kJoule = 1;

void keep_earlier(std::optional<Time>& best, std::optional<Time> candidate) {
  if (candidate && (!best || *candidate < *best)) best = candidate;
}

}  // namespace

World::World(WorldSetup setup, std::uint64_t seed)
    : robot_(std::move(setup.robot)),
      ground_(std::move(setup.ground)),
      windows_(std::move(setup.windows)),
      nav_(setup.start, robot_.names, seed),
      arm_(std::move(setup.arm_pose), std::move(setup.arm_joints), robot_.names, seed),
      camera_(seed),
      gripper_(seed),
      radio_(seed),
      battery_(setup.battery_j, robot_.power.capacity_j) {}

std::vector<Output> World::advance(Time now) {
  advance_to(now);
  return std::exchange(out_, {});
}

std::vector<Output> World::path_found(Time now, const ActivityKey& key, std::vector<terrain::Point> way) {
  advance_to(now);
  settle(now);
  if (!runs("nav", key) || !nav_.waits_for_path()) return done(now);
  const RobotView seen = view();
  Surroundings around = surroundings(seen);
  if (Ending failure = nav_.follow(std::move(way), now, around))
    break_off(nav_, now, Stage::failed, *failure);
  return done(now);
}

std::vector<Output> World::motion_found(Time now, const ActivityKey& key,
                                        const std::vector<JointTarget>& targets) {
  advance_to(now);
  settle(now);
  if (!runs("arm", key) || !arm_.waits_for_motion()) return done(now);
  const RobotView seen = view();
  Surroundings around = surroundings(seen);
  if (Ending failure = arm_.follow(targets, now, around)) break_off(arm_, now, Stage::failed, *failure);
  return done(now);
}

std::vector<Output> World::path_refused(Time now, const ActivityKey& key, Failure why) {
  advance_to(now);
  settle(now);
  if (runs("nav", key) && nav_.waits_for_path()) break_off(nav_, now, Stage::failed, std::move(why));
  return done(now);
}

std::vector<Output> World::motion_refused(Time now, const ActivityKey& key, Failure why) {
  advance_to(now);
  settle(now);
  if (runs("arm", key) && arm_.waits_for_motion()) break_off(arm_, now, Stage::failed, std::move(why));
  return done(now);
}

std::vector<Output> World::disturb(Time now, const Disturbance& disturbance) {
  advance_to(now);
  settle(now);
  if (const auto* fault = std::get_if<ComponentFault>(&disturbance)) {
    faults_[fault->component] = fault->until;
    with(fault->component, [&](auto& component) {
      break_off(component, now, Stage::failed, {"fault", "the component broke down"});
    });
  } else if (const auto* fall = std::get_if<RockFall>(&disturbance)) {
    ground_.hidden_rocks.push_back(fall->rock);
    const RobotView seen = view();
    Surroundings around = surroundings(seen);
    nav_.look_again(now, around);
  } else {
    battery_.add(-std::get<EnergyLoss>(disturbance).joules);
    settle(now);
  }
  return done(now);
}

std::optional<Time> World::next_change() const {
  std::optional<Time> best = next_report_;
  each([&](const auto& component) { keep_earlier(best, component.next_change()); });
  for (const Window& window : windows_) keep_earlier(best, window.next_change(now_));
  if (!battery_.flat()) {
    const Duration lasts = seconds(std::min(1e9, battery_.energy_j() / std::max(1e-3, peak_power_w())));
    keep_earlier(best, std::max(next_tick(), (now_ + lasts) / kTick * kTick));
  }
  return best;
}

std::optional<Time> World::next_event() const {
  std::optional<Time> best = next_tick();
  keep_earlier(best, next_report_);
  each([&](const auto& component) { keep_earlier(best, component.next_change()); });
  for (const Window& window : windows_) keep_earlier(best, window.next_change(now_));
  return best;
}

Time World::next_tick() const { return (now_ / kTick + 1) * kTick; }

void World::advance_to(Time now) {
  for (auto t = next_event(); t && *t <= now; t = next_event()) happen(*t);
}

void World::happen(Time t) {
  settle(t);
  each([&](auto& component) {
    if (component.next_change() != t) return;
    const RobotView seen = view();
    Surroundings around = surroundings(seen);
    const ActivityKey key = running_.find(component.name())->second;
    const Ending failure = component.finish(around);
    if (component.busy()) return;  // it goes on
    running_.erase(running_.find(component.name()));
    if (failure) {
      acknowledge(key, Stage::failed, failure->code, failure->reason, t);
    } else {
      acknowledge(key, Stage::completed, "done", "", t);
    }
    task_ended_ = true;
  });
  publish(t, task_ended_ || t == next_report_);
}

// Energy of [now_, t], with the tasks as they run; at most a tick long.
void World::settle(Time t) {
  double used = robot_.power.idle_w * to_seconds(t - now_);
  each([&](const auto& component) { used += component.energy_j(now_, t); });
  battery_.add(solar_power_w(robot_.power, now_ + (t - now_) / 2) * to_seconds(t - now_) - used);
  nav_.settle(t);
  arm_.settle(t);
  now_ = t;
  if (!battery_.flat()) return;
  each([&](auto& component) {
    break_off(component, t, Stage::failed, {"battery-flat", "the battery is empty"});
  });
}

std::vector<Output> World::done(Time now) {
  publish(now, task_ended_);
  if (moving()) next_report_ = std::min(next_report_, now + seconds(robot_.telemetry.moving_s));
  advance_to(now);
  return std::exchange(out_, {});
}

void World::publish(Time t, bool numbers) {
  each([&](const auto& component) {
    reporter_.report("rover." + std::string(component.name()), component.state(), t, out_);
  });
  for (const Window& window : windows_) reporter_.report(window.timeline, window.is_open(t), t, out_);
  for (const auto& [id, image] : images_) {
    reporter_.report("image." + id, State{image.sent ? "sent" : "stored", {}}, t, out_);
  }
  for (const auto& [id, state] : gripper_.samples()) reporter_.report("sample." + id, state, t, out_);
  task_ended_ = false;
  if (!numbers) return;
  reporter_.report_number("rover.x", nav_.pose().x, kMillimetre, t, out_);
  reporter_.report_number("rover.y", nav_.pose().y, kMillimetre, t, out_);
  reporter_.report_number("rover.heading", nav_.pose().heading, kMilliradian, t, out_);
  reporter_.report_number("rover.battery", battery_.energy_j(), kJoule, t, out_);
  for (std::size_t i = 0; i < arm_.joints().size(); ++i) {
    reporter_.report_number("arm.q" + std::to_string(i), arm_.joints()[i], kMilliradian, t, out_);
  }
  next_report_ = t + seconds(moving() ? robot_.telemetry.moving_s : robot_.telemetry.idle_s);
}

void World::acknowledge(const ActivityKey& key, Stage stage, std::string code, std::string reason, Time at) {
  Ack ack{key, stage, std::move(code), std::move(reason), at};
  ledger_.note(ack);
  out_.push_back(std::move(ack));
}

RobotView World::view() const {
  return {nav_.pose(), nav_.state(), arm_.state(), camera_.state(), gripper_.state(), radio_.state()};
}

Surroundings World::surroundings(const RobotView& seen) {
  return {robot_, ground_, windows_, seen, images_, out_};
}

bool World::runs(std::string_view component, const ActivityKey& key) const {
  const auto running = running_.find(component);
  return running != running_.end() && running->second == key;
}

double World::peak_power_w() const {
  double power = robot_.power.idle_w;
  each([&](const auto& component) { power += component.peak_power_w(); });
  return power;
}

bool World::moving() const { return nav_.next_change().has_value() || arm_.next_change().has_value(); }

}  // namespace roci::sim
