#include "planner_svc/network_store_service.hpp"

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "core/bytes/crc_32.hpp"
#include "core/durable/durable_file.hpp"
#include "planner_svc/limits.hpp"

namespace roci::planner {

namespace fs = std::filesystem;
using nlohmann::json;

namespace {

constexpr char kList[] = "orders.json";
constexpr int kFormat = 1;
// As many orders as are kept, each with all its reasons, or the largest network.
constexpr std::uintmax_t kMostBytes =
    std::uintmax_t{kNetworkOrders} * kReasons * kReasonBytes + kNetworkBytes;

std::string bytes_of(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file.string() + ": cannot be read");
  if (fs::file_size(file) > kMostBytes)
    throw std::runtime_error(file.string() + ": is larger than anything that is kept here");
  return {std::istreambuf_iterator<char>(in), {}};
}

json to_json(const NetworkRecord& one) {
  return {{"issuer", one.issuer},
          {"id", one.id},
          {"stage", static_cast<int>(one.stage)},
          {"parameter", one.parameter},
          {"value", one.value},
          {"network", one.model.name},
          {"version", one.model.version},
          {"after_version", one.after_version},
          {"plan_version", one.plan_version},
          {"reasons", one.reasons}};
}

NetworkRecord record_of(const json& from) {
  NetworkRecord out;
  out.issuer = from.at("issuer");
  out.id = from.at("id");
  const int stage = from.at("stage");
  if (stage < 0 || stage > static_cast<int>(NetworkStage::in_force))
    throw std::runtime_error("stage " + std::to_string(stage) + " is none");
  out.stage = static_cast<NetworkStage>(stage);
  out.parameter = from.at("parameter");
  out.value = from.at("value");
  out.model = {from.at("network"), from.at("version")};
  out.after_version = from.at("after_version");
  out.plan_version = from.at("plan_version");
  out.reasons = from.at("reasons").get<std::vector<std::string>>();
  return out;
}

}  // namespace

std::optional<KeptNetworks> NetworkStore::load() const {
  const fs::path list = file(kList);
  if (folder_.empty() || !fs::exists(list)) return std::nullopt;
  KeptNetworks out;
  try {
    const json text = json::parse(bytes_of(list));
    if (text.at("format") != kFormat) throw std::runtime_error("is of another format");
    for (const json& one : text.at("orders")) {
      NetworkRecord record = record_of(one);
      if (record.stage != NetworkStage::received) out.orders.push_back(std::move(record));
    }
    out.model = text.at("model");
    out.checksum = text.at("checksum");
  } catch (const std::exception& error) {
    throw std::runtime_error(list.string() + ": " + error.what());
  }
  if (out.model.empty()) return out;
  if (fs::path(out.model).filename() != out.model)
    throw std::runtime_error(list.string() + ": names a file of another folder");
  if (bytes::crc_32(bytes_of(file(out.model))) != out.checksum)
    throw std::runtime_error(file(out.model).string() + ": is not what was written (checksum)");
  return out;
}

void NetworkStore::keep(KeptNetworks& kept, const std::string* model) const {
  if (folder_.empty()) throw std::runtime_error("the run has no folder to keep it in");
  fs::create_directories(folder_);
  std::string name = kept.model;
  std::uint32_t checksum = kept.checksum;
  if (model != nullptr) {
    checksum = bytes::crc_32(*model);
    name = "network-" + std::to_string(checksum) + ".htn";
    durable::replace_file(file(name), *model);
  }
  json list{{"format", kFormat}, {"model", name}, {"checksum", checksum}, {"orders", json::array()}};
  for (const NetworkRecord& one : kept.orders) list["orders"].push_back(to_json(one));
  durable::replace_file(file(kList), list.dump(1, ' ', false, json::error_handler_t::replace) + "\n");
  std::error_code ignored;
  if (!kept.model.empty() && kept.model != name) fs::remove(file(kept.model), ignored);
  kept.model = std::move(name);
  kept.checksum = checksum;
}

void NetworkStore::clear() const {
  std::error_code ignored;
  if (!folder_.empty()) fs::remove_all(folder_, ignored);
}

}  // namespace roci::planner
