// The worker does long computations of a service beside its event loop.
#pragma once
#include <utility>

#include "services/node.hpp"
#include "services/node/job_queue.hpp"

namespace roci::services {

/// Runs long computations beside the event loop, on one thread, in the order in which they were given; the
/// simulated clock waits for them. Make it the last member of a service, so that its thread ends before what
/// the jobs use.
class Worker {
 public:
  explicit Worker(Node& node) : node_(node) {}

  /// Runs `work(stop_token)` on the thread, then `deliver` with its result on the loop.
  template <class Work, class Deliver>
  void compute(Work work, Deliver deliver) {
    const auto id = node_.begin_work();
    jobs_.push([&node = node_, id, work = std::move(work),
                deliver = std::move(deliver)](const std::stop_token& stop) {
      auto result = work(stop);
      node.post_work_result(id,
                            [deliver, result = std::move(result)]() mutable { deliver(std::move(result)); });
    });
  }

 private:
  Node& node_;
  node::JobQueue jobs_;
};

}  // namespace roci::services
