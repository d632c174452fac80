#include "rehearsal/check/asked_owners.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <optional>

#include "rehearsal/check/words.hpp"
#include "rehearsal/flight.hpp"
#include "services/clock/wall.hpp"
#include "services/publisher.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::rehearsal::check {

using planner::engine::FunctionCall, planner::engine::FunctionOutcome, planner::engine::FunctionValue;
using namespace std::chrono_literals;

namespace {

constexpr auto kOfferWait = 2s;  // of wall time, until a service that is there has offered its functions
constexpr auto kTurn = 20ms;     // of the asking node's loop
constexpr double kBatchTimeoutS =
    120;  // six times what planner_svc waits: a busy machine is no mistake of the mission

// Checks of one process do not hear each other.
int next_domain() {
  static std::atomic<int> last{0};
  return ++last;
}

std::unique_ptr<services::Node> node_of(services::node::NodeOptions options, int domain) {
  services::transport::TransportOptions transport;
  transport.domain = domain;
  transport.participant = options.name;
  return std::make_unique<services::Node>(options, services::transport::open_transport("inproc", transport));
}

bool is_asked(const mission::ServiceEntry& entry) {
  const std::string program = std::filesystem::path(entry.program).filename();
  return !entry.clock_master && program != "exec_svc" && program != "sim_svc" &&
         std::ranges::find(programs(), program, &Program::name) != programs().end();
}

services::node::NodeOptions live(services::node::NodeOptions options) {
  options.clock = services::clock::ClockMode::live;
  options.epoch_unix_us = services::clock::unix_us();
  return options;
}

}  // namespace

AskedOwners::AskedOwners(const std::filesystem::path& mission, const mission::ServiceList& services,
                         const std::string& scenario, mission::Findings& findings)
    : domain_(next_domain()) {
  for (const mission::ServiceEntry& entry : services.services)
    if (is_asked(entry)) seat(mission, entry, scenario, findings);
  mission::ServiceEntry self;
  self.name = "roci-check";
  node_ = node_of(live(node_options(mission, self, 0)), domain_);
  services::subscribe(*node_, services::topics::function_offer, [this](const v1::FunctionOffer& offer) {
    auto& functions = offered_[offer.module_name()];
    for (const v1::FunctionSignature& function : offer.functions())
      if (!contains(functions, function.name())) functions.push_back(function.name());
  });
  owners_ = std::make_unique<planner::FunctionOwners>(*node_, temporal::seconds(kBatchTimeoutS));
  for (Seat& one : seats_) one.thread = std::thread([&node = *one.node] { node.run(); });
}

AskedOwners::~AskedOwners() {
  for (Seat& one : seats_) one.node->stop();
  for (Seat& one : seats_)
    if (one.thread.joinable()) one.thread.join();
}

void AskedOwners::seat(const std::filesystem::path& mission, const mission::ServiceEntry& entry,
                       const std::string& scenario, mission::Findings& findings) {
  Seat seat;
  try {
    seat.node = node_of(live(node_options(mission, entry, 0)), domain_);
    services::RunSettings run;
    run.mission = mission;
    run.scenario = scenario;
    run.settings = entry.settings;
    seat.service = make_of(entry)(*seat.node, run);
    seats_.push_back(std::move(seat));
  } catch (const services::transport::TransportError&) {
    throw;
  } catch (const std::exception& error) {
    findings.add(error.what());
  }
}

void AskedOwners::await_offer(const std::string& module_name) {
  if (!awaited_.insert(module_name).second) return;
  const auto begun = services::clock::wall_now();
  while (!offered_.contains(module_name) && services::clock::wall_now() - begun < kOfferWait)
    node_->spin_once(kTurn);
}

const std::map<std::string, std::vector<std::string>>& AskedOwners::offered(
    const std::vector<std::string>& modules) {
  for (const std::string& module_name : modules) await_offer(module_name);
  return offered_;
}

std::vector<FunctionValue> AskedOwners::evaluate(std::span<const FunctionCall> calls,
                                                 const std::function<bool()>& cancelled) {
  if (calls.empty()) return {};
  await_offer(calls.front().module);
  std::optional<std::vector<FunctionValue>> values;
  owners_->ask({calls.begin(), calls.end()}, *request_,
               [&](std::vector<FunctionValue> answer) { values = std::move(answer); });
  while (!values) {
    if (cancelled()) {
      owners_->forget();
      return {calls.size(), FunctionValue{FunctionOutcome::late, 0, {}, "the check was given up"}};
    }
    node_->spin_once(kTurn);
  }
  return std::move(*values);
}

}  // namespace roci::rehearsal::check
