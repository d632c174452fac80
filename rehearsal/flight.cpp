#include "rehearsal/flight.hpp"

#include <exception>
#include <memory>
#include <mutex>
#include <thread>

#include "services/node.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::rehearsal {
namespace {

// A node with its service; the service goes first.
struct Seat {
  std::unique_ptr<services::Node> node;
  std::unique_ptr<services::Service> service;
};

services::node::NodeOptions node_options(const std::string& name, double pace) {
  services::node::NodeOptions options;
  options.name = name;
  options.vendor = "inproc";
  options.clock = services::clock::ClockMode::simulated;
  if (name == members().back().name) {
    options.clock = services::clock::ClockMode::master;
    options.master.pace = pace;
    for (const Member& member : members()) options.master.roster.push_back(member.name);
  }
  return options;
}

// The first failure of a flight's threads; it stops them all.
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

}  // namespace

void fly(const FlightOptions& options) {
  std::vector<Seat> seats;
  for (const Member& member : members()) {
    services::transport::TransportOptions transport;
    transport.domain = options.domain;
    transport.participant = member.name;
    Seat seat;
    seat.node = std::make_unique<services::Node>(node_options(member.name, options.pace),
                                                 services::transport::open_transport("inproc", transport));
    seat.service = member.make(*seat.node, options.run);
    seats.push_back(std::move(seat));
  }
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
}

}  // namespace roci::rehearsal
