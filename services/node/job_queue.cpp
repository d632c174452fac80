#include "services/node/job_queue.hpp"

#include <utility>

namespace roci::services::node {

JobQueue::JobQueue() : thread_([this](std::stop_token stop) { run(std::move(stop)); }) {}

JobQueue::~JobQueue() {
  thread_.request_stop();
  thread_.join();
}

void JobQueue::push(Job job) {
  {
    const std::lock_guard lock(mutex_);
    jobs_.push_back(std::move(job));
  }
  filled_.notify_one();
}

void JobQueue::run(std::stop_token stop) {
  while (true) {
    Job job;
    {
      std::unique_lock lock(mutex_);
      if (!filled_.wait(lock, stop, [this] { return !jobs_.empty(); }) || stop.stop_requested()) return;
      job = std::move(jobs_.front());
      jobs_.pop_front();
    }
    job(stop);
  }
}

}  // namespace roci::services::node
