#include "tests/unit/sim_svc/world_fixture.hpp"

#include <utility>

namespace roci::sim {

using services::owner::Ack;
using services::owner::CommandStatus;
using services::owner::Reception;
using services::owner::Request;
using temporal::seconds;
using temporal::State;
using temporal::Time;
using temporal::Value;
using world::Outputs;

std::shared_ptr<const terrain::Site> ramp_site(double grade) {
  const terrain::Grid grid{120, 120, 1.0, {0, 0}};
  terrain::SiteLayers layers;
  layers.rock_height.assign(grid.cell_count(), 0);
  layers.occupancy.assign(grid.cell_count(), terrain::Occupancy::free);
  for (std::size_t i = 0; i < grid.cell_count(); ++i) {
    layers.elevation.push_back(static_cast<float>(grade * grid.centre(grid.cell_at(i)).x));
  }
  return std::make_shared<terrain::Site>(grid, std::move(layers));
}

std::shared_ptr<const terrain::Site> flat_site() { return ramp_site(0); }

world::RobotSetup Rover::build() const {
  return {name,
          start,
          world::PowerSetup{power, battery_j},
          {},
          {part<components::Drive>("nav", "drive", drive), part<components::Arm>("arm", "arm", arm),
           part<components::Camera>("camera", "camera", camera),
           part<components::Gripper>("gripper", "gripper", gripper),
           part<components::Radio>("radio", "radio", radio)}};
}

world::WorldSetup FlatSetup::build() const {
  return {ground, {{"comm.window", {{seconds(1000), seconds(2000)}}}}, {robot.build()}};
}

Request execute(const std::string& activity, const std::string& component, const std::string& command,
                std::map<std::string, std::string> arguments, std::uint64_t epoch) {
  return {{activity, 1},       services::owner::Action::execute, epoch, "", "", component, command,
          std::move(arguments)};
}

Request drive_to(const std::string& activity, const std::string& place, double x, double y) {
  return execute(activity, "nav", "drive",
                 {{"to", place}, {"x", std::to_string(x)}, {"y", std::to_string(y)}});
}

std::optional<Value> last_value(const Outputs& outputs, const std::string& timeline) {
  std::optional<Value> found;
  for (const world::Output& output : outputs) {
    const auto* observed = std::get_if<world::Observed>(&output);
    if (observed && observed->timeline == timeline) found = observed->value;
  }
  return found;
}

double last_number(const Outputs& outputs, const std::string& timeline) {
  return std::get<double>(last_value(outputs, timeline).value());
}

std::vector<world::Product> products_in(const Outputs& outputs) {
  std::vector<world::Product> out;
  for (const world::Output& output : outputs)
    if (const auto* product = std::get_if<world::Product>(&output)) out.push_back(*product);
  return out;
}

void append(Outputs& to, Outputs more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

Flight::Flight(world::WorldSetup setup, std::uint64_t seed) : world(std::move(setup), seed) {
  advance(Time{});
}

namespace {

services::owner::CommandKey key_of(const world::TaskKey& key) {
  return {key.activity, key.attempt, key.commander, key.epoch};
}

world::TaskKey key_of(const services::owner::CommandKey& key) {
  return {key.activity, key.attempt, key.commander, key.issued_epoch};
}

CommandStatus status_of(const world::TaskReport& report) {
  using services::owner::Stage;
  static const std::map<world::TaskStage, Stage> stages{{world::TaskStage::accepted, Stage::accepted},
                                                        {world::TaskStage::rejected, Stage::rejected},
                                                        {world::TaskStage::completed, Stage::completed},
                                                        {world::TaskStage::failed, Stage::failed},
                                                        {world::TaskStage::cancelled, Stage::cancelled}};
  CommandStatus status{stages.at(report.stage), report.code, report.reason};
  if (report.results)
    status.results = {report.results->duration, report.results->energy_j, report.results->values};
  return status;
}

}  // namespace

// As the service does, in the order of the outputs.
void Flight::hear(Outputs outputs) {
  for (const world::Output& output : outputs) {
    const auto* report = std::get_if<world::TaskReport>(&output);
    if (!report) continue;
    const auto ack = report->stage == world::TaskStage::repairing
                         ? ledger.repair(key_of(report->key), report->reason, report->at)
                         : ledger.say(key_of(report->key), status_of(*report), report->at);
    if (ack) acks.push_back(*ack);
  }
  append(said, std::move(outputs));
}

void Flight::advance(Time now) { hear(world.advance(now)); }

void Flight::command(Time now, const Request& request) {
  hear(world.advance(now));
  const Reception reception = ledger.receive(request, now);
  if (reception.ack) acks.push_back(*reception.ack);
  if (reception.order == Reception::Order::carry_out) {
    const world::Task task{key_of(request.key), request.command, request.arguments, request.latest_end};
    hear(world.begin(now, {request.robot, request.subsystem, task}));
  } else if (reception.order == Reception::Order::break_off) {
    hear(world.halt(now, key_of(request.key), world::TaskStage::cancelled,
                    {"cancelled", "cancelled on request"}));
  }
}

void Flight::answer(Time now, const std::string& activity, const world::Answer& what) {
  hear(world.answer(now, {activity, 1}, what));
}

void Flight::disturb(Time now, const world::Disturbance& what) { hear(world.disturb(now, what)); }

void Flight::drive(Time now, const std::string& activity, const std::string& place, double x, double y,
                   const std::string& robot) {
  Request request = drive_to(activity, place, x, y);
  request.robot = robot;
  command(now, request);
  answer(now, activity, world::Way{{{x, y}}});
}

void Flight::move_arm(Time now, const std::string& activity, const std::string& from, const std::string& to,
                      std::vector<double> target, double duration_s) {
  command(now, execute(activity, "arm", "move", {{"from", from}, {"to", to}}));
  answer(now, activity, world::Trajectory{{{0, joints}, {duration_s, target}}});
  joints = std::move(target);
}

std::optional<Ack> Flight::last_ack(const std::string& activity) const {
  std::optional<Ack> found;
  for (const Ack& ack : acks) {
    if (ack.key.activity == activity) found = ack;
  }
  return found;
}

services::owner::Stage Flight::stage(const std::string& activity) const {
  const auto ack = last_ack(activity);
  return ack ? ack->status.stage : services::owner::Stage::unknown;
}

std::string Flight::code(const std::string& activity) const { return last_ack(activity).value().status.code; }

Time Flight::time_of(const std::string& activity) const { return last_ack(activity).value().at; }

State Flight::state(const std::string& timeline) const {
  return std::get<State>(last_value(said, timeline).value());
}

}  // namespace roci::sim
