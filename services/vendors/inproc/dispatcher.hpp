// The dispatcher is the delivery thread of one inproc participant.
#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <mutex>
#include <stop_token>
#include <thread>

namespace roci::services::vendors::inproc {

/// Runs the callbacks of the participant's endpoints one at a time, in posting order.
class Dispatcher {
 public:
  using Endpoint = std::uint64_t;

  Dispatcher();

  void post(Endpoint, std::function<void()> callback);
  /// Forgets the endpoint's callbacks and waits until none of them runs any more. It must not be called from
  /// a callback.
  void remove(Endpoint);

 private:
  struct Job {
    Endpoint endpoint;
    std::function<void()> callback;
  };

  void work(const std::stop_token&);

  std::mutex mutex_;
  std::condition_variable_any changed_;
  std::deque<Job> jobs_;
  Endpoint running_ = 0;  // 0: none
  std::jthread thread_;
};

}  // namespace roci::services::vendors::inproc
