#include "bench/house/house.hpp"

#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <stdexcept>

#include "services/launch/process_plan.hpp"
#include "services/publisher.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::bench::house {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;
namespace launch = services::launch;
namespace topics = services::topics;

constexpr char kIdle[] = "bench_house";  // the program of the processes that do nothing

std::unique_ptr<services::Node> observer(const HouseOptions& options, int domain) {
  services::node::NodeOptions node;
  node.name = "bench_house";
  node.incarnation = 0;
  node.clock = services::clock::ClockMode::observer;
  node.vendor = launch::console_vendor(options.dds);
  services::transport::TransportOptions transport;
  transport.domain = domain;
  transport.participant = node.name;
  return std::make_unique<services::Node>(node, services::transport::open_transport(node.vendor, transport));
}

launch::Options launch_options(const HouseOptions& options, const fs::path& run_folder, int domain) {
  launch::Options out;
  out.mission = options.mission;
  out.scenario = options.scenario;
  out.seed = options.seed;
  out.speed = options.pace;
  out.run_folder = run_folder;
  out.list = mission::load_service_list(options.mission);
  const std::size_t idle = static_cast<std::size_t>(options.processes) - 1 - out.list.services.size();
  for (std::size_t i = 1; i <= idle; ++i) {
    mission::ServiceEntry entry;
    entry.name = "idle_" + std::to_string(i);
    entry.program = kIdle;
    out.list.services.push_back(entry);
  }
  out.roster = out.list.names();
  out.run = "house";
  out.connection.dds = options.dds;
  out.connection.transport.domain = domain;
  return out;
}

}  // namespace

House::House(const HouseOptions& options, const fs::path& run_folder) : begun_(services::clock::wall_now()) {
  node_ = observer(options, domain_.id());
  services::subscribe(*node_, topics::clock_step, [this](const v1::ClockStep& step) { take(step); });
  services::subscribe(*node_, topics::command, [this](const v1::Command&) {
    if (!first_command_s_) first_command_s_ = since_begin();
  });
  start(options, run_folder);
}

House::~House() {
  for (const auto& child : children_) child->signal(SIGTERM);
  const auto begin = services::clock::wall_now();
  while (!all_ended() && services::clock::wall_now() - begin < 10s) node_->spin_once(20ms);
}

void House::start(const HouseOptions& options, const fs::path& run_folder) {
  fs::create_directories(run_folder);
  const launch::Options plan = launch_options(options, run_folder, domain_.id());
  const fs::path self = fs::read_symlink("/proc/self/exe");
  begun_ = services::clock::wall_now();
  for (const std::string& name : plan.roster) {
    const bool ours = plan.list.find(name)->program != kIdle;
    std::vector<std::string> arguments = launch::service_arguments(plan, name, 1, 0);
    if (!ours) arguments.insert(arguments.begin() + 1, {"--idle", kIdle});
    children_.push_back(std::make_unique<launch::Child>(ours ? options.bin / name : self, arguments,
                                                        run_folder / (name + ".log")));
  }
}

void House::wait_for_clock() {
  while (!first_step_s_) {
    node_->spin_once(2ms);
    if (any_ended() || since_begin() > 60)
      throw std::runtime_error("the clock did not begin; the logs of the services tell why");
  }
}

void House::listen(std::chrono::duration<double> time) {
  const auto begin = services::clock::wall_now();
  while (services::clock::wall_now() - begin < time) node_->spin_once(2ms);
}

bool House::wait_for_end() {
  while (!all_ended()) {
    node_->spin_once(2ms);
    if (since_begin() > 600) return false;
  }
  return true;
}

ProcessFigures House::figures() const {
  std::vector<pid_t> processes{::getpid()};
  for (const auto& child : children_) processes.push_back(child->pid());
  return figures_of(processes);
}

void House::take(const v1::ClockStep& step) {
  last_step_s_ = since_begin();
  if (!first_step_s_) first_step_s_ = last_step_s_;
  const bool new_time = step.time_us() != step_time_us_;
  if (new_time) {
    clock_.micro_steps += step.micro_step() + 1;
  } else if (step.micro_step() > micro_step_) {
    clock_.micro_steps += step.micro_step() - micro_step_;
  }
  step_time_us_ = step.time_us();
  micro_step_ = step.micro_step();
  clock_.sim_s = static_cast<double>(step.time_us()) / 1e6;
  std::uint64_t samples = 0;
  for (const v1::StreamCount& stream : step.totals()) samples += stream.total();
  clock_.samples = std::max(clock_.samples, samples);
}

bool House::any_ended() {
  return std::ranges::any_of(children_, [](const auto& child) { return child->ending().has_value(); });
}

bool House::all_ended() {
  return std::ranges::all_of(children_, [](const auto& child) { return child->ending().has_value(); });
}

double House::since_begin() const {
  return std::chrono::duration<double>(services::clock::wall_now() - begun_).count();
}

}  // namespace roci::bench::house
