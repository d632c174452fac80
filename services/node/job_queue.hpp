// The job queue is a thread beside the event loop that does one job after the other.
#pragma once
#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>

namespace roci::services::node {

/// Runs jobs on one thread, in the order in which they were given. Destruction stops the running job through
/// its token, drops the waiting ones and joins.
class JobQueue {
 public:
  using Job = std::function<void(std::stop_token)>;

  JobQueue();
  ~JobQueue();
  JobQueue(const JobQueue&) = delete;
  JobQueue& operator=(const JobQueue&) = delete;

  void push(Job job);

 private:
  void run(std::stop_token stop);

  std::mutex mutex_;
  std::condition_variable_any filled_;
  std::deque<Job> jobs_;
  std::jthread thread_;
};

}  // namespace roci::services::node
