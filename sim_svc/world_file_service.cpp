#include "sim_svc/world_file_service.hpp"

#include <cmath>
#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "core/durable/durable_file.hpp"
#include "services/log/log.hpp"
#include "services/owner/value_json.hpp"

namespace roci::sim {

using nlohmann::json;
using temporal::Time;
using world::Image;
using world::Pose;
using world::Product;
using world::RobotMemory;
using world::WorldMemory;

namespace {

json to_json(const Pose& pose) { return {pose.x, pose.y, pose.heading}; }

Pose pose_in(const json& in) {
  return {in.at(0).get<double>(), in.at(1).get<double>(), in.at(2).get<double>()};
}

json to_json(const Image& image) {
  return {
      {"robot", image.robot},    {"source", image.source},          {"bytes", image.bytes},
      {"sent", image.sent},      {"taken_us", image.taken.count()}, {"taken_from", to_json(image.taken_from)},
      {"preview", image.preview}};
}

Image image_in(const std::string& id, const json& in) {
  return {id,
          in.at("robot").get<std::string>(),
          in.at("source").get<std::string>(),
          in.at("bytes").get<std::uint64_t>(),
          in.at("sent").get<bool>(),
          Time(in.at("taken_us").get<std::int64_t>()),
          pose_in(in.at("taken_from")),
          in.at("preview").get<std::vector<std::uint8_t>>()};
}

json to_json(const Product& product) {
  return {{"id", product.id},
          {"kind", product.kind},
          {"robot", product.robot},
          {"source", product.source},
          {"bytes", product.bytes},
          {"tier", static_cast<int>(product.tier)},
          {"fate", static_cast<int>(product.fate)},
          {"created_us", product.created.count()},
          {"utility", product.utility}};
}

// Throws for a number that names none.
template <class Named>
Named named_in(const json& in, Named last) {
  const auto number = in.get<int>();
  if (number < 0 || number > static_cast<int>(last)) throw std::invalid_argument("no such number");
  return static_cast<Named>(number);
}

Product product_in(const json& in) {
  return {in.at("id").get<std::string>(),
          in.at("kind").get<std::string>(),
          in.at("robot").get<std::string>(),
          in.at("source").get<std::string>(),
          in.at("bytes").get<std::uint64_t>(),
          named_in(in.at("tier"), world::Tier::residual),
          named_in(in.at("fate"), world::Fate::lost),
          Time(in.at("created_us").get<std::int64_t>()),
          in.at("utility").get<std::vector<double>>()};
}

// Worlds that were kept before there was such data are read, too.
void read_body(const json& in, RobotMemory& out) {
  if (in.contains("temperatures_k"))
    out.temperatures_k = in["temperatures_k"].get<std::map<std::string, double>>();
  if (!in.contains("data")) return;
  for (const json& product : in["data"].at("products")) out.data.products.push_back(product_in(product));
  out.data.made = in["data"].at("made").get<std::map<std::string, std::uint32_t>>();
}

json to_json(const RobotMemory& robot) {
  json out{{"images", json::object()}, {"components", json::object()}};
  if (robot.pose) out["pose"] = to_json(*robot.pose);
  if (robot.energy_j) out["energy_j"] = *robot.energy_j;
  for (const auto& [id, image] : robot.images) out["images"][id] = to_json(image);
  if (!robot.temperatures_k.empty()) out["temperatures_k"] = robot.temperatures_k;
  if (!robot.data.made.empty()) {
    out["data"] = {{"products", json::array()}, {"made", robot.data.made}};
    for (const Product& product : robot.data.products) out["data"]["products"].push_back(to_json(product));
  }
  for (const auto& [name, memory] : robot.components) {
    json& component = out["components"][name] = json::object();
    for (const auto& [key, value] : memory) component[key] = services::owner::to_json(value);
  }
  return out;
}

RobotMemory robot_in(const json& in) {
  RobotMemory out;
  if (in.contains("pose")) out.pose = pose_in(in["pose"]);
  if (in.contains("energy_j")) out.energy_j = in["energy_j"].get<double>();
  for (const auto& [id, image] : in.at("images").items()) out.images.emplace(id, image_in(id, image));
  read_body(in, out);
  for (const auto& [name, memory] : in.at("components").items())
    for (const auto& [key, value] : memory.items())
      out.components[name][key] = services::owner::value_in(value);
  return out;
}

}  // namespace

std::string to_text(const WorldMemory& memory) {
  json out{{"at_us", memory.at.count()}, {"robots", json::object()}, {"samples", memory.samples}};
  for (const auto& [name, robot] : memory.robots) out["robots"][name] = to_json(robot);
  return out.dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

std::optional<WorldMemory> world_memory_from(const std::string& text) {
  try {
    const json in = json::parse(text);
    WorldMemory out{Time(in.at("at_us").get<std::int64_t>()),
                    {},
                    in.at("samples").get<std::map<std::string, std::string>>()};
    for (const auto& [name, robot] : in.at("robots").items()) out.robots[name] = robot_in(robot);
    return out;
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::optional<WorldMemory> WorldFile::read() const {
  std::ifstream in(file_);
  if (!in) return std::nullopt;
  auto memory = world_memory_from({std::istreambuf_iterator<char>(in), {}});
  if (!memory) services::log::warning(file_.string() + " cannot be read; the robot's world begins anew");
  return memory;
}

void WorldFile::keep(const WorldMemory& memory, services::clock::WallTime now) {
  std::string text = to_text(memory);
  if (text == written_) return;
  const bool sync = !synced_ || now - *synced_ >= kSyncEvery;
  try {
    durable::replace_file(file_, text, sync ? durable::Durability::power : durable::Durability::process);
    if (sync) synced_ = now;
    written_ = std::move(text);
    told_ = false;
  } catch (const std::system_error& error) {
    if (!std::exchange(told_, true))
      services::log::warning(std::string(error.what()) + "; it is tried again");
  }
}

}  // namespace roci::sim
