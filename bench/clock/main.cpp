// bench_clock measures how many micro-steps per second the simulated clock makes with seven services over one
// transport, each in its own process (inproc: on its own thread). One round is three micro-steps: the
// master's timer fires and writes a sample, the six others read it and write one each, the master reads
// those. It prints one JSON object.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <iostream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <thread>
#include <vector>

#include "services/clock/wall.hpp"
#include "services/launch/child.hpp"
#include "services/process/domain_claim.hpp"
#include "services/publisher.hpp"
#include "services/transport/plug_ins.hpp"

namespace {

using namespace std::chrono_literals;
using namespace roci::services;

constexpr int kMicroStepsOfARound = 3;
const std::vector<std::string> kNames{"s1", "s2", "s3", "s4", "s5", "s6", "s7"};

struct Arguments {
  std::string dds = "inproc";
  int rounds = 3000;
  int domain = 0;
  std::string role;  // empty: the whole bench; else one follower
};

std::unique_ptr<Node> make_node(const Arguments& arguments, const std::string& name) {
  node::NodeOptions options;
  options.name = name;
  options.clock = name == kNames.front() ? clock::ClockMode::master : clock::ClockMode::simulated;
  options.master.roster = kNames;
  options.vendor = arguments.dds;
  transport::TransportOptions transport;
  transport.domain = arguments.domain;
  transport.participant = name;
  return std::make_unique<Node>(options, transport::open_transport(arguments.dds, transport));
}

void follow(Node& node) {
  roci::v1::Observation answer;
  answer.timeline(node.options().name);
  subscribe(node, topics::event,
            [answers = advertise(node, topics::observation), answer](const roci::v1::Event&) { answers.write(answer); });
  node.run();
}

double run_master(Node& node, int rounds) {
  clock::WallTime begun;
  clock::WallTime ended;
  int round = 0;
  const auto questions = advertise(node, topics::event);
  subscribe(node, topics::observation, [](const roci::v1::Observation&) {});
  std::function<void()> tick = [&] {
    if (round == 0) begun = clock::wall_now();
    if (++round > rounds) {
      ended = clock::wall_now();
      node.stop();
      return;
    }
    questions.write({});
    node.after(1ms, tick);
  };
  node.after(1ms, tick);
  node.run();
  return std::chrono::duration<double>(ended - begun).count();
}

double run_in_threads(const Arguments& arguments) {
  std::vector<std::unique_ptr<Node>> nodes;
  for (const auto& name : kNames) nodes.push_back(make_node(arguments, name));
  std::vector<std::jthread> threads;
  for (std::size_t i = 1; i < nodes.size(); ++i) threads.emplace_back([&node = *nodes[i]] { follow(node); });
  return run_master(*nodes.front(), arguments.rounds);
}

double run_in_processes(const Arguments& arguments) {
  const auto self = std::filesystem::read_symlink("/proc/self/exe");
  std::vector<std::unique_ptr<roci::services::launch::Child>> children;
  for (std::size_t i = 1; i < kNames.size(); ++i) {
    children.push_back(std::make_unique<roci::services::launch::Child>(
        self,
        std::vector<std::string>{"bench_clock", "--dds", arguments.dds, "--domain", std::to_string(arguments.domain),
                                 "--role", kNames[i]},
        "/dev/null"));
  }
  return run_master(*make_node(arguments, kNames.front()), arguments.rounds);
}

int bench(Arguments arguments) {
  const process::DomainClaim domain;
  arguments.domain = domain.id();
  const bool threads = arguments.dds == "inproc";
  const double wall_s = threads ? run_in_threads(arguments) : run_in_processes(arguments);
  const int steps = kMicroStepsOfARound * arguments.rounds;
  std::cout << nlohmann::json{{"bench", "clock"},
                              {"dds", arguments.dds},
                              {"services", kNames.size()},
                              {"micro_steps", steps},
                              {"wall_s", wall_s},
                              {"micro_steps_per_s", steps / wall_s}}
            << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  Arguments arguments;
  CLI::App app("Micro-steps per second of the simulated clock");
  app.add_option("--dds", arguments.dds, "Transport")->capture_default_str();
  app.add_option("--rounds", arguments.rounds, "Rounds of three micro-steps")->capture_default_str();
  app.add_option("--domain", arguments.domain, "Internal: domain of a follower");
  app.add_option("--role", arguments.role, "Internal: run as this follower");
  CLI11_PARSE(app, argc, argv);
  try {
    if (arguments.role.empty()) return bench(arguments);
    follow(*make_node(arguments, arguments.role));
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "bench_clock: " << error.what() << "\n";
    return 1;
  }
}
