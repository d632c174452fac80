// A run under the simulated clock inside the test: each node on its own thread, over any transport.
#pragma once

#include <atomic>
#include <exception>
#include <future>
#include <map>
#include <memory>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "services/node.hpp"
#include "services/transport/plug_ins.hpp"

namespace roci::services {

// Domains of this test program; DDS transports need one that no other process uses.
inline int next_domain() {
  static std::atomic<int> last{100};
  return ++last;
}

// Thrown by a handler: the service dies without a word.
struct Crash {};

class SimRun {
 public:
  explicit SimRun(std::vector<std::string> roster, int domain = next_domain())
      : roster_(std::move(roster)), domain_(domain) {}

  ~SimRun() {
    for (auto& member : members_) {
      if (member->thread.joinable() && member->node) member->node->stop();
    }
    join();
  }

  // The first service of the roster is the master.
  Node& add(const std::string& name, std::uint32_t incarnation = 1, const std::string& vendor = "inproc") {
    node::NodeOptions options;
    options.name = name;
    options.incarnation = incarnation;
    options.clock = name == roster_.front() ? clock::ClockMode::master : clock::ClockMode::simulated;
    options.master = master;
    options.master.roster = roster_;
    options.vendor = vendor;
    options.links = links;
    if (const auto robot = robots.find(name); robot != robots.end()) options.robot = robot->second;
    auto member = std::make_unique<Member>();
    member->name = name;
    member->node = std::make_unique<Node>(options, transport(vendor));
    Node& node = *member->node;
    const std::scoped_lock lock(mutex_);
    members_.push_back(std::move(member));
    return node;
  }

  // The newest incarnation.
  Node& node(const std::string& name) {
    for (auto member = members_.rbegin(); member != members_.rend(); ++member) {
      if ((*member)->name == name) return *(*member)->node;
    }
    throw std::out_of_range(name);
  }

  std::unique_ptr<transport::Transport> transport(const std::string& vendor = "inproc") const {
    transport::TransportOptions options;
    options.domain = domain_;
    options.participant = "test";
    return transport::open_transport(vendor, options);
  }

  // Starts the nodes that were added since the last start.
  void start() {
    const std::scoped_lock lock(mutex_);
    for (auto& member : members_) {
      if (member->thread.joinable() || member->ran) continue;
      member->ran = true;
      member->thread = std::thread([m = member.get()] {
        try {
          m->node->run();
        } catch (const Crash&) {
          m->node.reset();  // as the end of its process would
          m->crashed.set_value();
        } catch (...) {
          m->error = std::current_exception();
        }
      });
    }
  }

  void wait_for_crash(const std::string& name) {
    for (std::size_t i = 0; Member* member = at(i); ++i) {
      if (member->name == name) return member->crashed.get_future().wait();
    }
  }

  // Handlers may add and start services meanwhile.
  void join() {
    for (std::size_t i = 0; Member* member = at(i); ++i) {
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

  node::MasterOptions master;
  link::LinkTable links;  // of the nodes that are added from then on
  std::map<std::string, std::string> robots;  // by service, of those nodes

 private:
  struct Member {
    std::string name;
    std::unique_ptr<Node> node;
    std::thread thread;
    bool ran = false;
    std::promise<void> crashed;
    std::exception_ptr error;
  };
  Member* at(std::size_t index) {
    const std::scoped_lock lock(mutex_);
    return index < members_.size() ? members_[index].get() : nullptr;
  }

  std::vector<std::string> roster_;
  int domain_;
  std::mutex mutex_;
  std::vector<std::unique_ptr<Member>> members_;
};

}  // namespace roci::services
