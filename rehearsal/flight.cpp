#include "rehearsal/flight.hpp"

#include <algorithm>
#include <exception>
#include <fstream>
#include <functional>
#include <memory>
#include <mutex>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <thread>

#include "rehearsal/loaded.hpp"
#include "services/link/link_file.hpp"
#include "services/node.hpp"
#include "services/node/make_event.hpp"
#include "services/process/link_report.hpp"
#include "services/publisher.hpp"
#include "services/topics/topics.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::rehearsal {
namespace {

// Is a node with its service; the service goes first.
struct Seat {
  std::unique_ptr<services::Node> node;
  std::unique_ptr<services::Service> service;
};

// Holds the first failure of a flight's threads, which stops them all.
class FirstFailure {
 public:
  void set(std::exception_ptr error) {
    const std::lock_guard lock(mutex_);
    if (!error_) error_ = std::move(error);
  }
  void rethrow() const {
    if (error_) std::rethrow_exception(error_);
  }

 private:
  std::mutex mutex_;
  std::exception_ptr error_;
};

// Writes what the services say in a flight into its run folder, in mission time.
// It takes no part in the clock, so it changes nothing.
class Listener {
 public:
  explicit Listener(const FlightOptions& options)
      : out_(options.run.run_folder / kEventsFile), node_(node_of(options), transport_of(options)) {
    services::subscribe(node_, services::topics::event, [this](const v1::Event& event) {
      if (event.header().sender() == kListener) heard_all_ = true;
      if (heard_all_) return;
      out_ << nlohmann::json{{"time_us", event.header().stamp_us()},
                             {"sender", event.header().sender()},
                             {"code", event.code()},
                             {"text", event.text()}}
                  .dump(-1, ' ', false, nlohmann::json::error_handler_t::replace)
           << "\n";
    });
    thread_ = std::thread([this] { node_.run(); });
  }
  ~Listener() {
    node_.stop();
    thread_.join();
    // What was said last may still be on its way to this participant; its own word comes after all of that. Where there
    // is no room for it, it is said again.
    const auto end = services::advertise(node_, services::topics::event);
    while (!heard_all_) {
      end.write(services::node::make_event(v1::SEVERITY_INFO, "scenario.over", ""));
      node_.spin_once(std::chrono::milliseconds(100));
    }
  }

 private:
  static services::node::NodeOptions node_of(const FlightOptions& options) {
    services::node::NodeOptions out;
    out.name = kListener;
    out.mission = std::filesystem::absolute(options.run.mission).lexically_normal().filename().string();
    out.run = out.mission;
    out.incarnation = 0;
    out.vendor = "inproc";
    out.clock = services::clock::ClockMode::observer;
    return out;
  }
  static std::unique_ptr<services::transport::Transport> transport_of(const FlightOptions& options) {
    services::transport::TransportOptions out;
    out.domain = options.domain;
    out.participant = kListener;
    return services::transport::open_transport("inproc", out);
  }

  static constexpr char kListener[] = "rehearsal";

  std::ofstream out_;
  bool heard_all_ = false;
  services::Node node_;
  std::thread thread_;
};

}  // namespace

std::vector<mission::ServiceEntry> crew_of(const std::filesystem::path& mission) {
  std::vector<mission::ServiceEntry> crew = mission::load_service_list(mission).services;
  std::ranges::stable_partition(crew, std::logical_not<>{}, &mission::ServiceEntry::clock_master);
  if (crew.empty() || !crew.back().clock_master)
    throw std::invalid_argument("no service of this mission has clock: master; a rehearsal needs one");
  return crew;
}

services::node::NodeOptions node_options(const std::filesystem::path& mission,
                                         const mission::ServiceEntry& entry, double pace) {
  services::node::NodeOptions options;
  options.name = entry.name;
  options.mission = std::filesystem::absolute(mission).lexically_normal().filename().string();
  options.run = options.mission;
  options.robot = entry.robot;
  options.vendor = "inproc";
  options.clock =
      entry.clock_master ? services::clock::ClockMode::master : services::clock::ClockMode::simulated;
  if (!entry.clock_master) return options;
  options.master.pace = pace;
  for (const mission::ServiceEntry& other : crew_of(mission)) options.master.roster.push_back(other.name);
  return options;
}

services::MakeService* make_of(const mission::ServiceEntry& entry, const std::vector<Program>& more) {
  const auto linked = std::ranges::find(programs(), entry.program, &Program::name);
  if (linked != programs().end()) return linked->make;
  const std::string file = std::filesystem::path(entry.program).filename();
  if (const auto own = std::ranges::find(more, file, &Program::name); own != more.end()) return own->make;
  return load_service(entry.program);
}

void fly(const FlightOptions& options) {
  const auto links = services::link::load_links(options.run.mission, options.run.scenario, options.run.seed);
  std::vector<Seat> seats;
  for (const mission::ServiceEntry& entry : crew_of(options.run.mission)) {
    services::transport::TransportOptions transport;
    transport.domain = options.domain;
    transport.participant = entry.name;
    Seat seat;
    services::node::NodeOptions node = node_options(options.run.mission, entry, options.pace);
    node.links = links;
    seat.node =
        std::make_unique<services::Node>(node, services::transport::open_transport("inproc", transport));
    services::RunSettings run = options.run;
    run.settings = entry.settings;
    seat.service = make_of(entry, options.programs)(*seat.node, run);
    seats.push_back(std::move(seat));
  }
  const auto listener = options.run.run_folder.empty() ? nullptr : std::make_unique<Listener>(options);
  FirstFailure failure;
  std::vector<std::thread> threads;
  for (Seat& seat : seats) {
    threads.emplace_back([&seat, &seats, &failure] {
      try {
        seat.node->run();
      } catch (...) {
        failure.set(std::current_exception());
        for (Seat& other : seats) other.node->stop();
      }
    });
  }
  for (std::thread& thread : threads) thread.join();
  failure.rethrow();
  for (const Seat& seat : seats) services::process::write_link_report(*seat.node, options.run.run_folder);
}

}  // namespace roci::rehearsal
