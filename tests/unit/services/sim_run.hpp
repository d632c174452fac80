// A run under the simulated clock inside the test: each node on its own thread, over any transport.
#pragma once

#include <atomic>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "services/node.hpp"
#include "services/transport.hpp"

namespace roci::services {

// Domains of this test program; DDS transports need one that no other process uses.
inline int next_domain() {
  static std::atomic<int> last{100};
  return ++last;
}

class SimRun {
 public:
  explicit SimRun(std::vector<std::string> roster, int domain = next_domain())
      : roster_(std::move(roster)), domain_(domain) {}

  ~SimRun() {
    for (auto& member : members_) member->node->stop();
    join();
  }

  // The first service of the roster is the master.
  Node& add(const std::string& name, std::uint32_t incarnation = 1, const std::string& vendor = "inproc") {
    NodeOptions options;
    options.name = name;
    options.incarnation = incarnation;
    options.clock = name == roster_.front() ? ClockMode::master : ClockMode::simulated;
    options.master = master;
    options.master.roster = roster_;
    options.vendor = vendor;
    members_.push_back(std::make_unique<Member>());
    members_.back()->node = std::make_unique<Node>(options, transport(vendor));
    return *members_.back()->node;
  }

  // The newest incarnation.
  Node& node(const std::string& name) {
    for (auto member = members_.rbegin(); member != members_.rend(); ++member) {
      if ((*member)->node->options().name == name) return *(*member)->node;
    }
    throw std::out_of_range(name);
  }

  std::unique_ptr<Transport> transport(const std::string& vendor = "inproc") const {
    TransportOptions options;
    options.domain = domain_;
    options.participant = "test";
    return open_transport(vendor, options);
  }

  // Starts the nodes that were added since the last start.
  void start() {
    for (auto& member : members_) {
      if (member->thread.joinable() || member->ran) continue;
      member->ran = true;
      member->thread = std::thread([m = member.get()] {
        try {
          m->node->run();
        } catch (...) {
          m->error = std::current_exception();
        }
      });
    }
  }

  void join() {
    for (auto& member : members_) {
      if (member->thread.joinable()) member->thread.join();
    }
  }

  // Starts all and waits until the run is over. Throws the first exception that a node's run() threw.
  void run() {
    start();
    join();
    for (auto& member : members_) {
      if (member->error) std::rethrow_exception(member->error);
    }
  }

  MasterOptions master;

 private:
  struct Member {
    std::unique_ptr<Node> node;
    std::thread thread;
    bool ran = false;
    std::exception_ptr error;
  };
  std::vector<std::string> roster_;
  int domain_;
  std::vector<std::unique_ptr<Member>> members_;
};

}  // namespace roci::services
