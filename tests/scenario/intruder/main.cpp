// Somebody on a run's domain who knows its identity and says what he likes: commands, acknowledgements and heartbeats
// in other services' names. He reads what to do from standard input, a line each, and prints what he hears.
//   intruder DDS DOMAIN RUN
//   as NAME                             speaks in this name from now on; first as exec_svc
//   send ACTION OWNER SUBSYSTEM COMMAND ACTIVITY ISSUED SENDER_EPOCH [argument=value …]
//   beat SERVICE INCARNATION TIMES      heartbeats, four a second
//   stop SERVICE INCARNATION TIMES      the same, and each says that the service stops
//   observe TIMELINE STATE [argument …]   tells once of a timeline, latched, when somebody listens
//   acknowledge OWNER ACTIVITY ISSUED     a last word on a command, as if he were its owner
//   repeat SECONDS                      sends every command that he hears again, twice
//   flood SECONDS                       well-formed goals, observations, hazards and requests, as fast as he can
//   await SECONDS TEXT                  until a line that was heard holds the text; fails after that time
#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "services/clock/wall.hpp"
#include "services/node.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::scenario {
namespace {

namespace topics = services::topics;
using services::clock::wall_now;
using services::clock::wall_seconds;
using namespace std::chrono_literals;

services::node::NodeOptions options_of(const std::string& vendor, const std::string& run,
                                       const std::string& name) {
  services::node::NodeOptions options;
  options.name = name;
  options.run = run;
  options.clock = services::clock::ClockMode::observer;
  options.vendor = vendor;
  return options;
}

services::transport::TransportOptions transport_of(int domain) {
  services::transport::TransportOptions options;
  options.domain = domain;
  options.participant = "intruder";
  return options;
}

// One name under which he speaks.
struct Voice {
  Voice(const std::string& vendor, int domain, const std::string& run, const std::string& name)
      : node(options_of(vendor, run, name),
             services::transport::open_transport(vendor, transport_of(domain))),
        commands(services::advertise(node, topics::command)),
        beats(services::advertise(node, topics::heartbeat)),
        observations(services::advertise(node, topics::observation)),
        acks(services::advertise(node, topics::command_ack)) {}
  services::Node node;
  services::Publisher<v1::Command> commands;
  services::Publisher<v1::Heartbeat> beats;
  services::Publisher<v1::Observation> observations;
  services::Publisher<v1::CommandAck> acks;
};

class Intruder {
 public:
  Intruder(std::string vendor, int domain, std::string run)
      : vendor_(std::move(vendor)), domain_(domain), run_(std::move(run)) {
    speak_as("exec_svc");
    services::Node& node = voice_->node;
    services::subscribe(node, topics::command_ack, [this](const v1::CommandAck& ack) { hear(ack); });
    services::subscribe(node, topics::event, [this](const v1::Event& event) {
      note("event " + event.header().sender() + " " + event.code() + " " + event.text());
    });
    services::subscribe(node, topics::command, [this](const v1::Command& command) {
      const std::string key = command.activity() + " " + std::to_string(command.attempt());
      if (!repeats_ || !repeated_.insert(key).second) return;
      for (int i = 0; i < 2; ++i) voice_->commands.write(command);
    });
  }

  bool act(const std::string& line) {
    std::istringstream in(line);
    std::string what;
    in >> what;
    if (what == "as") {
      in >> what;
      speak_as(what);
      return true;
    }
    if (what == "send") return send(in);
    if (what == "beat") return beat(in, v1::SERVICE_RUNNING);
    if (what == "stop") return beat(in, v1::SERVICE_STOPPING);
    if (what == "observe") return observe(in);
    if (what == "acknowledge") return acknowledge(in);
    double seconds = 0;
    in >> seconds;
    if (what == "flood") return flood(seconds);
    if (what == "repeat") {
      repeats_ = true;
      spin(seconds, [] { return false; });
      repeats_ = false;
      return true;
    }
    std::string text;
    std::getline(in >> std::ws, text);
    return await(seconds, text);
  }

 private:
  void speak_as(const std::string& name) {
    auto& voice = voices_[name];
    if (!voice) voice = std::make_unique<Voice>(vendor_, domain_, run_, name);
    voice_ = voice.get();
  }

  bool send(std::istringstream& in) {
    std::string action;
    v1::Command out;
    std::uint64_t issued = 0, epoch = 0;
    in >> action >> out.owner() >> out.subsystem() >> out.command_name() >> out.activity() >> issued >> epoch;
    out.action(action == "query"    ? v1::COMMAND_QUERY
               : action == "cancel" ? v1::COMMAND_CANCEL
                                    : v1::COMMAND_EXECUTE);
    out.commander("exec_svc");
    out.attempt(1);
    out.epoch(issued);
    out.sender_epoch(epoch);
    out.latest_end_us(-1);
    for (std::string argument; in >> argument;) {
      v1::Property property;
      property.name(argument.substr(0, argument.find('=')));
      property.value(argument.substr(argument.find('=') + 1));
      out.arguments().push_back(std::move(property));
    }
    // Until its owner answers: others are discovered before him, perhaps.
    const std::string answer = "ack " + out.activity() + " " + std::to_string(issued) + " ";
    const std::size_t before = heard_.size();
    for (int i = 0; i < 20; ++i) {
      voice_->commands.write(out);
      const auto answered = [&] {
        return std::any_of(heard_.begin() + static_cast<std::ptrdiff_t>(before), heard_.end(),
                           [&](const std::string& line) { return line.starts_with(answer); });
      };
      if (spin(1, answered)) return true;
    }
    std::cout << "nobody answered: " << action << " " << out.activity() << std::endl;
    return false;
  }

  bool beat(std::istringstream& in, v1::ServiceState state) {
    v1::Heartbeat out;
    std::uint32_t incarnation = 0;
    int times = 0;
    in >> out.service() >> incarnation >> times;
    out.incarnation(incarnation);
    out.state(state);
    out.host("elsewhere");
    out.process_id(1);
    spin(20, [this] { return voice_->beats.matched_readers() > 1; });
    for (int i = 0; i < times; ++i) {
      voice_->beats.write(out);
      spin(0.25, [] { return false; });
    }
    return true;
  }

  bool observe(std::istringstream& in) {
    v1::Observation out;
    in >> out.timeline() >> out.observed().state();
    out.observed().kind(v1::VALUE_STATE);
    for (std::string argument; in >> argument;) out.observed().arguments().push_back(argument);
    voice_->observations.write(out);
    return spin(60, [this] { return voice_->observations.matched_readers() > 0; });
  }

  bool acknowledge(std::istringstream& in) {
    v1::CommandAck out;
    std::uint64_t issued = 0;
    in >> out.owner() >> out.activity() >> issued;
    out.commander("exec_svc");
    out.epoch(issued);
    out.attempt(1);
    out.stage(v1::STAGE_COMPLETED);
    voice_->acks.write(out);
    return spin(60, [this] { return voice_->acks.matched_readers() > 0; });
  }

  // Each goal, timeline and hazard has a name of its own; none changes what the mission does.
  bool flood(double seconds) {
    services::Node& node = voice_->node;
    const auto goals = services::advertise(node, topics::goal);
    const auto observations = services::advertise(node, topics::observation);
    const auto hazards = services::advertise(node, topics::hazard);
    const auto paths = services::make_client(node, topics::path_request);
    const bool found = spin(20, [&] {
      return goals.matched_readers() > 0 && observations.matched_readers() > 0 &&
             hazards.matched_readers() > 0;
    });
    if (!found) return false;
    std::uint64_t sent = 0;
    const auto send_some = [&] {
      for (int i = 0; i < 20; ++i) {
        const std::string name = "flood-" + std::to_string(++sent);
        v1::Goal goal;
        goal.issuer("intruder");
        goal.id(name);
        goal.goal_kind("nonsense");
        goals.write(goal);
        v1::Observation observation;
        observation.timeline(name);
        observation.observed().number(static_cast<double>(sent));
        observations.write(observation);
        v1::Hazard hazard;
        hazard.found_by("intruder");
        hazard.id(name);
        hazard.radius_m(-1);
        hazards.write(hazard);
      }
      v1::PathRequest request;
      request.origin().x_m(-1e6);
      request.goal_pose().x_m(1e6);
      paths.call(request, "", 1s, [](const auto&) {});
      return false;
    };
    spin(seconds, send_some);
    std::cout << "flooded " << sent << std::endl;
    return true;
  }

  bool await(double seconds, const std::string& text) {
    const auto found = [&] {
      return std::ranges::any_of(
          heard_, [&](const std::string& line) { return line.find(text) != std::string::npos; });
    };
    if (spin(seconds, found)) return true;
    std::cout << "nobody said: " << text << std::endl;
    return false;
  }

  template <class Done>
  bool spin(double seconds, Done done) {
    const auto end = wall_now() + wall_seconds(seconds);
    while (!done()) {
      if (wall_now() >= end) return false;
      for (const auto& [name, voice] : voices_) voice->node.spin_once(5ms);
    }
    return true;
  }

  void hear(const v1::CommandAck& ack) {
    static const std::vector<std::string> stages{"accepted",  "rejected",      "completed", "failed",
                                                 "cancelled", "cancel-failed", "unknown"};
    note("ack " + ack.activity() + " " + std::to_string(ack.epoch()) + " " + stages.at(ack.stage()) + " " +
         ack.code() + " newest " + std::to_string(ack.newest_epoch()));
  }

  void note(const std::string& line) {
    std::cout << line << std::endl;
    heard_.push_back(line);
  }

  const std::string vendor_;
  const int domain_;
  const std::string run_;
  std::map<std::string, std::unique_ptr<Voice>> voices_;
  Voice* voice_ = nullptr;
  std::vector<std::string> heard_;
  std::set<std::string> repeated_;
  bool repeats_ = false;
};

}  // namespace
}  // namespace roci::scenario

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  roci::scenario::Intruder intruder(argv[1], std::stoi(argv[2]), argv[3]);
  for (std::string line; std::getline(std::cin, line);)
    if (!line.empty() && !intruder.act(line)) return 1;
  return 0;
}
