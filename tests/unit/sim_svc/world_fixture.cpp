#include "tests/unit/sim_svc/world_fixture.hpp"

#include <stdexcept>

namespace roci::sim {

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

WorldSetup flat_setup() {
  WorldSetup setup;
  setup.ground.site = flat_site();
  setup.windows = {{"comm.window", {{seconds(1000), seconds(2000)}}}};
  setup.start = {20, 20, 0};
  setup.arm_pose = "stow";
  setup.arm_joints = {0, 0, 0, 0, 0};
  setup.battery_j = 500000;
  return setup;
}

Request execute(const std::string& activity, const std::string& component, const std::string& command,
                std::map<std::string, std::string> arguments, std::uint64_t epoch) {
  return {{activity, 1}, Action::execute, component, command, std::move(arguments), epoch};
}

Request drive_to(const std::string& activity, const std::string& place, double x, double y) {
  return execute(activity, "nav", "drive",
                 {{"to", place}, {"x", std::to_string(x)}, {"y", std::to_string(y)}});
}

std::optional<Ack> last_ack(const std::vector<Output>& outputs, const std::string& activity) {
  std::optional<Ack> found;
  for (const Output& output : outputs) {
    const auto* ack = std::get_if<Ack>(&output);
    if (ack && ack->key.activity == activity) found = *ack;
  }
  return found;
}

std::optional<Value> last_value(const std::vector<Output>& outputs, const std::string& timeline) {
  std::optional<Value> found;
  for (const Output& output : outputs) {
    const auto* observed = std::get_if<Observed>(&output);
    if (observed && observed->timeline == timeline) found = observed->value;
  }
  return found;
}

double last_number(const std::vector<Output>& outputs, const std::string& timeline) {
  return std::get<double>(last_value(outputs, timeline).value());
}

void append(std::vector<Output>& to, std::vector<Output> more) {
  to.insert(to.end(), std::make_move_iterator(more.begin()), std::make_move_iterator(more.end()));
}

Flight::Flight(WorldSetup setup, std::uint64_t seed) : world(std::move(setup), seed) { advance(Time{}); }

void Flight::advance(Time now) { append(said, world.advance(now)); }

void Flight::command(Time now, const Request& request) { append(said, world.command(now, request)); }

void Flight::drive(Time now, const std::string& activity, const std::string& place, double x, double y) {
  command(now, drive_to(activity, place, x, y));
  append(said, world.path_found(now, {activity, 1}, {{x, y}}));
}

void Flight::move_arm(Time now, const std::string& activity, const std::string& from, const std::string& to,
                      std::vector<double> target, double duration_s) {
  command(now, execute(activity, "arm", "move", {{"from", from}, {"to", to}}));
  append(said, world.motion_found(now, {activity, 1}, {{0, joints}, {duration_s, target}}));
  joints = std::move(target);
}

Stage Flight::stage(const std::string& activity) const {
  const auto ack = last_ack(said, activity);
  return ack ? ack->stage : Stage::unknown;
}

std::string Flight::code(const std::string& activity) const { return last_ack(said, activity).value().code; }

Time Flight::time_of(const std::string& activity) const { return last_ack(said, activity).value().at; }

State Flight::state(const std::string& timeline) const {
  return std::get<State>(last_value(said, timeline).value());
}

}  // namespace roci::sim
