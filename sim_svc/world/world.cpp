#include "sim_svc/world/world.hpp"

#include <algorithm>
#include <set>
#include <stdexcept>
#include <utility>

#include "sim_svc/world/match.hpp"

namespace roci::sim::world {

using temporal::Duration;
using temporal::Time;

namespace {

constexpr Duration kTick{1000000};  // batteries are settled at least this often

void keep_earlier(std::optional<Time>& best, std::optional<Time> candidate) {
  if (candidate && (!best || *candidate < *best)) best = candidate;
}

template <class Named>
void check_unique(const std::vector<Named>& all, const std::string& what) {
  std::set<std::string> names;
  for (const Named& one : all) {
    if (!names.insert(one.name).second) {
      throw std::invalid_argument("two " + what + " are named '" + one.name + "'");
    }
  }
}

}  // namespace

World::World(WorldSetup setup, std::uint64_t seed)
    : environment_{std::move(setup.ground), std::move(setup.windows), {}, {}, {}} {
  environment_.ground.surface.seed = seed;
  scatter(environment_.ground.surface.soil, seed);
  check_unique(setup.robots, "robots");
  for (RobotSetup& robot : setup.robots) {
    check_unique(robot.components, "components of '" + robot.name + "'");
    robots_.emplace_back(std::move(robot), robots_.empty(), seed);
  }
}

Robot* World::robot(const std::string& name) {
  if (name.empty() && robots_.size() == 1) return &robots_.front();
  const auto found =
      std::find_if(robots_.begin(), robots_.end(), [&](const Robot& one) { return one.name() == name; });
  return found == robots_.end() ? nullptr : &*found;
}

std::string World::robot_names() const {
  std::string out;
  for (const Robot& one : robots_) out += (out.empty() ? "" : ", ") + one.name();
  return out;
}

bool World::runs(const TaskKey& key) const {
  return std::any_of(robots_.begin(), robots_.end(), [&](const Robot& one) { return one.runs(key); });
}

WorldMemory World::memory() const {
  WorldMemory out{now_, {}, environment_.samples};
  for (const Robot& one : robots_) out.robots[one.name()] = one.memory(now_);
  return out;
}

void World::restore(const WorldMemory& memory) {
  now_ = memory.at;
  environment_.samples = memory.samples;
  for (Robot& one : robots_)
    if (const auto own = memory.robots.find(one.name()); own != memory.robots.end())
      one.restore(own->second, memory.at);
}

Outputs World::advance(Time now) {
  advance_to(now);
  return std::exchange(out_, {});
}

Outputs World::begin(Time now, const Order& order) {
  advance_to(now);
  settle(now);
  const Task& task = order.task;
  if (Robot* one = robot(order.robot)) {
    if (one->begin(order.component, task, now, environment_, out_)) {
      begun_.push_back({now, one->name(), order.component, task});
    }
  } else {
    const std::string reason = order.robot.empty() ? "the command names no robot, and there are several: "
                                                   : "no robot '" + order.robot + "'; known: ";
    out_.push_back(TaskReport{task.key, TaskStage::rejected, "unknown-robot", reason + robot_names(), now});
  }
  return done(now);
}

Outputs World::halt(Time now, const TaskKey& key, TaskStage stage, const Failure& why) {
  advance_to(now);
  settle(now);
  for (Robot& one : robots_) one.halt(key, stage, why, now, environment_, out_);
  return done(now);
}

Outputs World::answer(Time now, const TaskKey& key, const Answer& answer) {
  advance_to(now);
  settle(now);
  for (Robot& one : robots_) one.answer(key, answer, now, environment_, out_);
  return done(now);
}

Outputs World::disturb(Time now, const Disturbance& disturbance) {
  advance_to(now);
  settle(now);
  apply(now, disturbance);
  return done(now);
}

void World::apply(Time now, const Disturbance& disturbance) {
  const auto with = [this](const std::string& name, const auto& act) {
    if (Robot* one = robot(name)) act(*one);
  };
  std::visit(
      Match{[&](const ComponentFault& fault) {
              with(fault.robot, [&](Robot& one) {
                if (fault.pace)
                  one.slow_component(fault.component, *fault.pace, fault.until, now, environment_, out_);
                else
                  one.break_component(fault.component, fault.until, now, environment_, out_);
              });
            },
            [&](const RockFall& fall) {
              environment_.ground.hidden_rocks.push_back(fall.rock);
              for (Robot& one : robots_) one.ground_changed(now, environment_, out_);
            },
            [&](const SoilChange& change) {
              environment_.ground.surface.soil.areas.push_back(change.area);
              for (Robot& one : robots_) one.ground_changed(now, environment_, out_);
            },
            [&](const EnergyLoss& loss) {
              with(loss.robot, [&](Robot& one) { one.lose_energy(loss.joules); });
              settle(now);
            },
            [&](const EnergyDrop& drop) {
              with(drop.robot, [&](Robot& one) { one.drop_energy(drop.to_j); });
              settle(now);
            },
            [&](const GenerationLoss& dim) {
              with(dim.robot, [&](Robot& one) { one.lose_generation(dim.share, dim.until); });
            },
            [&](const ComponentMishap& mishap) {
              with(mishap.robot, [&](Robot& one) { one.suffer(mishap.what, now, environment_, out_); });
            },
            [&](const HollowSuccess& hollow) {
              with(hollow.robot, [&](Robot& one) { one.hollow_success(hollow.component, hollow.command); });
            },
            [&](const SurroundingsChange& change) {
              for (Robot& one : robots_) one.set_surroundings(change.kelvin, now, environment_, out_);
            },
            [&](const SuddenHeat& heat) {
              with(heat.robot,
                   [&](Robot& one) { one.add_heat(heat.zone, heat.joules, now, environment_, out_); });
            },
            [&](const RateChange& change) {
              with(change.robot, [&](Robot& one) { one.change_rate(change.component, change.factor, now); });
            },
            [&](const ViewBlock& block) {
              for (Window& window : environment_.windows)
                if (window.timeline == block.window) window.shut(now, block.until);
              for (Robot& one : robots_) one.surroundings_changed(now, environment_, out_);
            }},
      disturbance);
}

Outputs World::heed(Time now, const DownlinkSchedule& schedule) {
  advance_to(now);
  settle(now);
  if (Robot* one = robot(schedule.robot)) one->heed(schedule);
  return done(now);
}

std::optional<Time> World::next_change() const {
  std::optional<Time> best;
  for (const Robot& one : robots_) {
    keep_earlier(best, one.next_change());
    if (const auto flat = one.flat_at(now_)) keep_earlier(best, std::max(next_tick(), *flat / kTick * kTick));
  }
  for (const Window& window : environment_.windows) keep_earlier(best, window.next_change(now_));
  return best;
}

bool World::has_data_under_way() const {
  return std::ranges::any_of(robots_, [](const Robot& one) { return one.has_data_under_way(); });
}

Time World::next_event() const {
  std::optional<Time> best = next_tick();
  for (const Robot& one : robots_) keep_earlier(best, one.next_change());
  for (const Window& window : environment_.windows) keep_earlier(best, window.next_change(now_));
  return std::max(*best, now_);  // what fell due while nobody simulated the world is due now
}

Time World::next_tick() const { return (now_ / kTick + 1) * kTick; }

void World::advance_to(Time now) {
  for (Time t = next_event(); t <= now; t = next_event()) {
    settle(t);
    for (Robot& one : robots_) one.finish_due(t, environment_, out_);
    for (Robot& one : robots_) one.run_routines(t, environment_, out_);
    publish(t);
  }
}

void World::settle(Time t) {
  for (Robot& one : robots_) one.settle(now_, t, environment_, out_);
  for (const Robot& one : robots_)
    if (one.pose()) environment_.poses[one.name()] = *one.pose();
  now_ = t;
}

Outputs World::done(Time now) {
  publish(now);
  for (Robot& one : robots_) one.hasten_numbers(now);
  advance_to(now);
  return std::exchange(out_, {});
}

void World::publish(Time t) {
  for (const Robot& one : robots_) one.report_components(t, reporter_, out_);
  for (const Window& window : environment_.windows)
    reporter_.report(window.timeline, window.is_open(t), t, out_);
  for (Robot& one : robots_) one.report_things(t, reporter_, out_);
  for (Robot& one : robots_) one.report_numbers_if_due(t, reporter_, out_);
}

}  // namespace roci::sim::world
