#include "planner_svc/network_orders_service.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/bytes/crc_32.hpp"
#include "planner_svc/limits.hpp"
#include "services/node/make_event.hpp"
#include "services/topics/topics.hpp"

namespace roci::planner {

using engine::ModelAnswer, engine::ModelChange, engine::ModelName;

namespace {

namespace topics = services::topics;

constexpr char kNetwork[] = "network";
constexpr char kParameters[] = "parameters";

// A status is a page; what goes beyond is counted.
std::vector<std::string> bounded(std::vector<std::string> reasons) {
  const std::size_t all = reasons.size();
  if (all > kReasons) {
    reasons.resize(kReasons);
    reasons.push_back("and " + std::to_string(all - kReasons) + " more");
  }
  for (std::string& reason : reasons)
    if (reason.size() > kReasonBytes) reason.resize(kReasonBytes);
  return reasons;
}

}  // namespace

NetworkOrders::NetworkOrders(services::Node& node, const Settings& settings,
                             const std::filesystem::path& folder, std::function<void()> heard)
    : node_(node),
      settings_(settings),
      store_(folder),
      heard_(std::move(heard)),
      statuses_(services::advertise(node, topics::network_status)),
      events_(services::advertise(node, topics::event)) {
  if (node.options().incarnation <= 1) store_.clear();
  try {
    kept_ = store_.load().value_or(KeptNetworks{});
  } catch (const std::exception& error) {
    give_up_kept(error.what());
  }
  // What was accepted and perhaps stood in no plan yet: a network is the model's file, a value is told again.
  for (const NetworkRecord& one : kept_.orders)
    if (one.stage == NetworkStage::accepted && !one.parameter.empty())
      waiting_.push_back({one.issuer, one.id, std::nullopt, one.parameter, one.value});
  services::subscribe(node_, topics::network_order, [this](const v1::NetworkOrder& order) { hear(order); });
  if (!kept_.orders.empty())
    node_.at(node_.now(), [this] {
      for (const NetworkRecord& one : kept_.orders) tell(one);
    });
}

std::filesystem::path NetworkOrders::model_file() const {
  return kept_.model.empty() ? std::filesystem::path() : store_.file(kept_.model);
}

void NetworkOrders::give_up_kept(const std::string& why) {
  kept_ = {};
  waiting_.clear();
  node_.at(node_.now(), [this, why] {
    report(v1::SEVERITY_ERROR, "planner.network_damaged",
           why + "; the mission's own network is in force; send the ground's again");
  });
}

NetworkRecord* NetworkOrders::record(const Key& key) {
  const auto found = std::ranges::find_if(kept_.orders, [&](const NetworkRecord& one) {
    return one.issuer == key.first && one.id == key.second;
  });
  return found == kept_.orders.end() ? nullptr : &*found;
}

void NetworkOrders::hear(const v1::NetworkOrder& order) {
  const std::string& robot = node_.options().robot;
  if (!robot.empty() && !order.robot().empty() && order.robot() != robot) return;
  const Key key{order.issuer(), order.id()};
  if (key.first.size() + key.second.size() > kNameBytes) {
    report(v1::SEVERITY_WARNING, "planner.no_room",
           "a network order is not taken in: its key has more than " + std::to_string(kNameBytes) + " bytes");
    return;
  }
  if (record(key) == nullptr && kept_.orders.size() >= kNetworkOrders) {
    report(v1::SEVERITY_WARNING, "planner.no_room",
           "a network order is not taken in: " + std::to_string(kNetworkOrders) + " are kept at most");
    return;
  }
  headers_[key] = order.header();
  if (const NetworkRecord* known = record(key)) {
    tell(*known);
    return;
  }
  NetworkRecord& added = kept_.orders.emplace_back();
  added.issuer = key.first;
  added.id = key.second;
  const bool sets = order.order_kind() == v1::NETWORK_SET_PARAMETER;
  if (sets) {
    added.parameter = order.parameter();
    added.value = order.amount();
  }
  if (auto faults = faults_of(order); !faults.empty()) {
    settle(added, NetworkStage::refused, std::move(faults));
    keep(nullptr);
    tell(added);
    return;
  }
  added.model = model_;
  tell(added);
  ModelChange change{key.first, key.second, std::nullopt, order.parameter(), order.amount()};
  if (!sets) change.model.emplace(order.content().begin(), order.content().end());
  waiting_.push_back(std::move(change));
  heard_();
}

std::vector<std::string> NetworkOrders::faults_of(const v1::NetworkOrder& order) const {
  const bool sets = order.order_kind() == v1::NETWORK_SET_PARAMETER;
  const char* const right = sets ? kParameters : kNetwork;
  if (std::ranges::find(settings_.uploads, right) == settings_.uploads.end())
    return {std::string("the mission does not let the ground ") +
            (sets ? "set parameters" : "replace the network") + "; write 'ground: {uploads: [" + right +
            "]}' in mission.yaml"};
  if (!store_.keeps()) return {"the run has no folder to keep it in; start the planner with a run folder"};
  if (sets) {
    if (order.parameter().empty()) return {"no parameter is named; write its name as the network has it"};
    if (!std::isfinite(order.amount())) return {"the value of '" + order.parameter() + "' is no number"};
    return {};
  }
  const std::size_t size = order.content().size();
  if (size > kNetworkBytes || order.content_size() > kNetworkBytes)
    return {std::to_string(std::max<std::uint64_t>(size, order.content_size())) +
            " bytes are more than the " + std::to_string(kNetworkBytes) +
            " that are taken; make the network smaller"};
  if (size != order.content_size())
    return {"at byte " + std::to_string(size) + ": it ends here, although " +
            std::to_string(order.content_size()) + " bytes were sent; send it again"};
  const auto networks = std::ranges::count_if(waiting_, [](const ModelChange& one) { return !!one.model; });
  if (networks >= static_cast<std::ptrdiff_t>(kNetworksWaiting))
    return {std::to_string(kNetworksWaiting) + " networks wait for the planner already; send it later"};
  const std::string_view content(reinterpret_cast<const char*>(order.content().data()),
                                 order.content().size());
  if (bytes::crc_32(content) != order.checksum())
    return {"the checksum is that of another content: bytes were changed on the way; send it again"};
  return {};
}

std::vector<ModelChange> NetworkOrders::take() {
  taken_ = std::exchange(waiting_, {});
  return taken_;
}

NetworkOrders::Model NetworkOrders::answer(const std::vector<ModelAnswer>& answers, const ModelName& model,
                                           std::uint32_t last_version) {
  const bool first = model_.name.empty() && !model.name.empty();
  Model out = Model::same;
  const bool renamed = model != model_;
  model_ = model;
  for (const ModelChange& change : std::exchange(taken_, {})) {
    NetworkRecord* const one = record({change.issuer, change.id});
    if (one == nullptr) continue;
    const auto said = std::ranges::find_if(answers, [&](const ModelAnswer& answer) {
      return answer.issuer == change.issuer && answer.id == change.id;
    });
    if (said == answers.end()) {
      settle(*one, NetworkStage::refused,
             {"engine '" + settings_.engine + "' takes no changes of its model"});
      keep(nullptr);
    } else if (!said->refused.empty()) {
      settle(*one, NetworkStage::refused, said->refused);
      keep(nullptr);
    } else {
      one->after_version = last_version;
      settle(*one, NetworkStage::accepted, {});
      const std::string unkept = keep(change.model ? &*change.model : nullptr);
      if (change.model) out = unkept.empty() ? Model::replaced : Model::unkept;
      if (change.model && !unkept.empty())
        settle(*one, NetworkStage::refused,
               {"it cannot be kept: " + unkept + "; make room there and send it again"});
    }
    tell(*one);
  }
  if (first || renamed) tell_model();
  return out;
}

void NetworkOrders::fail(const std::string& why) {
  for (const ModelChange& change : std::exchange(taken_, {})) {
    NetworkRecord* const one = record({change.issuer, change.id});
    if (one == nullptr) continue;
    settle(*one, NetworkStage::refused, {"the engine failed at it: " + why});
    keep(nullptr);
    tell(*one);
  }
}

void NetworkOrders::executed(std::uint32_t version) {
  bool any = false;
  for (NetworkRecord& one : kept_.orders) {
    if (one.stage != NetworkStage::accepted || version <= one.after_version) continue;
    one.plan_version = version;
    settle(one, NetworkStage::in_force, {});
    tell(one);
    any = true;
  }
  if (any) keep(nullptr);
}

void NetworkOrders::nothing_to_plan() {
  bool any = false;
  for (NetworkRecord& one : kept_.orders) {
    if (one.stage != NetworkStage::accepted) continue;
    settle(one, NetworkStage::in_force, {});
    tell(one);
    any = true;
  }
  if (any) keep(nullptr);
}

void NetworkOrders::settle(NetworkRecord& one, NetworkStage stage, std::vector<std::string> reasons) {
  one.stage = stage;
  one.model = model_;
  one.reasons = bounded(std::move(reasons));
  const std::string who = one.issuer + "/" + one.id;
  const std::string what =
      one.parameter.empty() ? "the network of " + who : who + ": parameter '" + one.parameter + "'";
  if (stage == NetworkStage::refused) {
    report(v1::SEVERITY_WARNING, "network.refused",
           what + " is refused: " + one.reasons.front() +
               (one.reasons.size() > 1 ? " (and " + std::to_string(one.reasons.size() - 1) + " more)" : ""));
  } else if (stage == NetworkStage::accepted) {
    report(v1::SEVERITY_INFO, "network.accepted", what + " is accepted");
  } else if (stage == NetworkStage::in_force) {
    report(
        v1::SEVERITY_INFO, "network.in_force",
        what + " is in force" +
            (one.plan_version == 0 ? "; there is nothing to plan now"
                                   : " with version " + std::to_string(one.plan_version) + " of the plan"));
  }
}

// Returns why it could not be.
std::string NetworkOrders::keep(const std::string* model) {
  if (!store_.keeps()) return {};
  try {
    store_.keep(kept_, model);
    return {};
  } catch (const std::exception& error) {
    report(v1::SEVERITY_ERROR, "planner.network_unwritten",
           std::string(error.what()) + "; a planner that starts again does not know of it; make room there");
    return error.what();
  }
}

void NetworkOrders::tell(const NetworkRecord& one) {
  v1::NetworkStatus status;
  status.planner(node_.options().name);
  status.issuer(one.issuer);
  status.id(one.id);
  if (const auto header = headers_.find({one.issuer, one.id}); header != headers_.end())
    status.answers(header->second);
  status.stage(static_cast<v1::NetworkStage>(one.stage));
  status.network(one.model.name);
  status.network_version(one.model.version);
  status.plan_version(one.plan_version);
  status.reasons(one.reasons);
  statuses_.write(std::move(status));
}

// Under no issuer's key: which model is in force.
void NetworkOrders::tell_model() {
  v1::NetworkStatus status;
  status.planner(node_.options().name);
  status.stage(v1::NETWORK_IN_FORCE);
  status.network(model_.name);
  status.network_version(model_.version);
  statuses_.write(std::move(status));
}

void NetworkOrders::report(v1::Severity severity, const std::string& code, const std::string& text) {
  events_.write(services::node::make_event(severity, code, text));
}

}  // namespace roci::planner
