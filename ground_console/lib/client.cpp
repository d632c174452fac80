#include "ground_console/lib/client.hpp"

#include <unistd.h>

#include <algorithm>
#include <stdexcept>
#include <thread>
#include <utility>

#include "services/clock/wall.hpp"
#include "services/process/run_record.hpp"
#include "services/rpc.hpp"
#include "services/topics/topics.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::console::lib {
namespace {

namespace topics = services::topics;
using std::chrono::milliseconds;

// No other console ever has the same name, so that an answer is that of nobody else's goal.
services::node::NodeOptions observer(const services::process::Connection& connection) {
  services::node::NodeOptions options;
  options.name = "roci-" + std::to_string(::getpid()) + "-" + std::to_string(services::clock::unix_us());
  options.incarnation = 0;
  options.clock = services::clock::ClockMode::observer;
  options.vendor = connection.dds;
  options.run = connection.run;
  return options;
}

std::string described(const services::process::RunRecord& run) {
  return "  --domain " + std::to_string(run.domain) + "   " + run.mission.filename().string() + " (" +
         run.scenario + ", " + run.dds + ")";
}

// Also of a child that nobody has waited for: its record is gone, and it will never have another.
bool has_ended(std::int64_t pid) {
  constexpr int kState = 3;
  const std::string state = services::process::stat_field(pid, kState);
  return state.empty() || state == "Z";
}

}  // namespace

services::process::Connection choose_run(const services::process::ConnectionFlags& flags,
                                         std::int64_t launcher) {
  const auto environment = services::process::process_environment();
  services::process::ConnectionFlags chosen = flags;
  std::string run;
  if (!flags.domain && !flags.network && !environment("ROCI_DOMAIN") && !environment("ROCI_NETWORK")) {
    auto runs = services::process::find_runs(services::process::runtime_folder());
    if (launcher != 0)
      std::erase_if(runs, [&](const services::process::RunRecord& one) { return one.pid != launcher; });
    const auto refused = services::process::refused_runs(services::process::runtime_folder());
    if (runs.empty() && !refused.empty()) throw std::runtime_error("a mission runs, but " + refused.front());
    if (runs.empty())
      throw NoRun("no mission runs on this machine; start one with ./run, or name its --domain");
    if (runs.size() > 1) {
      std::string text = "several missions run on this machine; name one:";
      for (const services::process::RunRecord& other : runs) text += "\n" + described(other);
      throw std::runtime_error(text);
    }
    chosen.domain = runs.front().domain;
    run = runs.front().run;
    if (!runs.front().network.empty()) chosen.network = runs.front().network;
    if (!chosen.secure && !runs.front().keys.empty()) chosen.secure = runs.front().keys;
    if (!chosen.dds) chosen.dds = runs.front().dds;
    if (!chosen.address) chosen.address = runs.front().address;
    if (!chosen.peers) {
      std::string peers;
      for (const std::string& peer : runs.front().peers) peers += (peers.empty() ? "" : ",") + peer;
      chosen.peers = peers;
    }
  }
  services::process::Connection connection = services::process::resolve_connection(chosen, environment, {});
  if (connection.dds == "mixed") connection.dds = "cyclonedds";
  connection.run = run;
  return connection;
}

std::optional<services::process::RunRecord> local_run(const services::process::ConnectionFlags& flags,
                                                      std::int64_t launcher) {
  auto runs = services::process::find_runs(services::process::runtime_folder());
  if (launcher != 0)
    std::erase_if(runs, [&](const services::process::RunRecord& run) { return run.pid != launcher; });
  const auto domain = flags.domain;
  if (domain)
    std::erase_if(runs, [&](const services::process::RunRecord& run) { return run.domain != *domain; });
  if (runs.size() != 1) return std::nullopt;
  return runs.front();
}

bool wait_for_launcher(std::int64_t pid) {
  for (; !has_ended(pid); std::this_thread::sleep_for(milliseconds(100))) {
    const auto runs = services::process::find_runs(services::process::runtime_folder());
    if (std::ranges::any_of(runs, [&](const services::process::RunRecord& run) { return run.pid == pid; }))
      return true;
  }
  return false;
}

services::process::Connection wait_for_run(const services::process::ConnectionFlags& flags,
                                           const std::function<void()>& tell_waiting) {
  for (bool told = false;; told = true) {
    try {
      return choose_run(flags);
    } catch (const NoRun&) {
      if (!told) tell_waiting();
    }
    std::this_thread::sleep_for(milliseconds(200));
  }
}

Client::Client(const services::process::Connection& connection)
    : node_(observer(connection), services::transport::open_transport(
                                      connection.dds, services::process::admitted(connection, "roci"))),
      goals_(services::advertise(node_, topics::goal)),
      orders_(services::advertise(node_, topics::order)),
      network_orders_(services::advertise(node_, topics::network_order)) {
  services::subscribe(node_, topics::network_status, [this](const v1::NetworkStatus& status) {
    constexpr std::size_t kMost = 10'000;
    const std::tuple key{status.planner(), status.issuer(), status.id()};
    if (networks_.size() < kMost || networks_.contains(key)) networks_[key] = status;
    if (status.answers().sender() == name()) network_stages_.push_back(status);
  });
  follow(topics::mission_status);
  follow(topics::goal);
  follow(topics::goal_status);
  follow(topics::plan);
  follow(topics::executed_plan);
  follow(topics::step_status);
  follow(topics::observation);
  follow(topics::data_product);
  follow(topics::hazard);
  follow(topics::event);
  follow(topics::heartbeat);
  follow(topics::exec_member);
  follow(topics::decision);
  follow(topics::order_status);
  follow(topics::function_offer);
  follow(topics::downlink_schedule);
  follow(topics::mission_outlook);
  follow(topics::command);
  follow(topics::command_ack);
  follow(topics::known_map);
}

template <class T>
void Client::follow(const services::topics::Topic<T>& topic) {
  services::subscribe(node_, topic, [this](const T& value) { view_.take(value); });
}

bool Client::over() const { return view_.ended() || (launcher_ != 0 && has_ended(launcher_)); }

bool Client::wait(const std::function<bool()>& done, milliseconds limit) {
  const auto end = services::clock::wall_now() + limit;
  while (!done()) {
    if (services::clock::wall_now() >= end) return false;
    node_.spin_once(milliseconds(50));
  }
  return true;
}

void Client::catch_up() {
  wait([] { return false; }, milliseconds(300));
}

void Client::settle(milliseconds quiet, milliseconds limit) {
  const auto end = services::clock::wall_now() + limit;
  const auto known = [this] {
    return view_.services().size() + view_.timelines().size() + view_.goals().size() + view_.maps().size() +
           view_.missions().size();
  };
  std::size_t seen = 0;
  do {
    seen = known();
    wait([&] { return known() > seen; }, quiet);
  } while (known() > seen && services::clock::wall_now() < end);
}

std::optional<v1::GoalStatus> Client::send_goal(const v1::Goal& goal, milliseconds limit) {
  wait_for_mission(limit);
  goals_.write(goal);
  const auto& statuses = view_.goals();
  const MissionView::GoalKey key{goal.issuer(), goal.id()};
  const auto answered = [&, number = goals_.written()] {
    const auto status = statuses.find(key);
    return status != statuses.end() && status->second.answers().sender() == node_.options().name &&
           status->second.answers().seq() == number;
  };
  if (!wait(answered, limit)) return std::nullopt;
  return statuses.at(key);
}

std::optional<v1::OrderStatus> Client::send_order(const v1::Order& order,
                                                  const std::function<void(const v1::OrderStatus&)>& tell,
                                                  milliseconds limit) {
  wait_for_mission(limit);
  orders_.write(order);
  const auto stages = [&]() -> const auto& { return view_.order(order.issuer(), order.id()); };
  std::optional<v1::OrderStatus> last;
  const auto answers_this = [&, number = orders_.written()](const v1::OrderStatus& status) {
    return status.answers().sender() == node_.options().name && status.answers().seq() == number;
  };
  std::size_t seen = 0;
  do {
    for (; seen < stages().size(); ++seen) {
      if (!answers_this(stages()[seen])) continue;
      last = stages()[seen];
      tell(*last);
    }
    if (last && (last->stage() == v1::ORDER_REFUSED || last->stage() == v1::ORDER_APPLIED)) return last;
  } while (wait([&] { return stages().size() > seen; }, limit));
  return last;
}

std::optional<v1::NetworkStatus> Client::send_network_order(
    const v1::NetworkOrder& order, const std::function<void(const v1::NetworkStatus&)>& tell,
    milliseconds limit) {
  wait_for_mission(limit);
  network_stages_.clear();
  network_orders_.write(order);
  std::optional<v1::NetworkStatus> last;
  std::size_t seen = 0;
  while (wait([&] { return network_stages_.size() > seen; }, limit)) {
    last = network_stages_[seen++];
    tell(*last);
    if (last->stage() == v1::NETWORK_REFUSED || last->stage() == v1::NETWORK_IN_FORCE) break;
  }
  return last;
}

std::optional<v1::PathReply> Client::find_path(Place from, Place to, const std::string& service,
                                               milliseconds limit, std::string& why) {
  v1::PathRequest request;
  request.origin().x_m(from.x_m);
  request.origin().y_m(from.y_m);
  request.goal_pose().x_m(to.x_m);
  request.goal_pose().y_m(to.y_m);
  std::optional<services::CallResult<v1::PathReply>> result;
  const auto paths = services::make_client(node_, topics::path_request);
  paths.call(std::move(request), service, limit, [&](const auto& ended) { result = ended; });
  wait([&] { return result.has_value(); }, limit + milliseconds(500));
  why = result ? result->reason : "it took too long";
  if (!result || result->status != services::rpc::CallStatus::ok) return std::nullopt;
  return result->reply;
}

bool Client::wait_for_mission(milliseconds limit) {
  return wait([this] { return view_.mission() != nullptr; }, limit);
}

}  // namespace roci::console::lib
