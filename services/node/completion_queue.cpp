#include "services/node/completion_queue.hpp"

#include <stdexcept>
#include <utility>

namespace roci::services::node {

std::uint64_t CompletionQueue::begin() { return *begun_.insert(next_++).first; }

void CompletionQueue::finish(std::uint64_t work, std::function<void()> run) {
  if (!begun_.contains(work))
    throw std::logic_error("post_work_result: this work was never begun, or ended already");
  finished_.emplace(work, std::move(run));
}

void CompletionQueue::run_finished() {
  while (!finished_.empty()) {
    const auto result = finished_.begin();
    if (order_ == ResultOrder::as_begun && result->first != *begun_.begin()) return;
    const auto run = std::move(result->second);
    const std::uint64_t work = result->first;
    finished_.erase(result);
    run();
    begun_.erase(work);
  }
}

}  // namespace roci::services::node
