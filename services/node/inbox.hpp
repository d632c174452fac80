// The inbox is where other threads leave things for the loop: samples from vendor threads, results of
// workers, wake-ups.
#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <mutex>
#include <unordered_map>
#include <vector>

#include "services/clock/wall.hpp"
#include "services/transport/transport.hpp"

namespace roci::services::node {

struct TopicReader;

/// Holds a sample that has arrived on a topic.
struct Arrival {
  TopicReader* topic = nullptr;
  transport::Sample sample;
};

/// Holds the result of a worker, which the loop runs.
struct WorkResult {
  std::uint64_t work = 0;
  std::function<void()> run;
};

/// Hands what other threads leave to the loop, in their order. Any thread may call it.
class Inbox {
 public:
  struct Batch {
    std::vector<Arrival> arrivals;
    std::vector<WorkResult> results;
    bool matched = false;  ///< some endpoint's matches have changed
    bool stop = false;     ///< stays true once asked for
  };

  /// Adds a sample. Returns false, and drops it, when kInboxSamples of its topic wait already, or more than `room`
  /// bytes would: the loop is slower than its peers, or somebody floods the topic. Other topics are not affected.
  bool push(Arrival, std::size_t room);
  void push(WorkResult);
  void matched();
  void stop();

  /// Removes and returns all that has come. Waits for something until `deadline`, not at all if that has
  /// passed.
  Batch take(clock::WallTime deadline);

 private:
  std::mutex mutex_;
  std::condition_variable filled_;
  struct Load {
    std::size_t samples = 0;
    std::size_t bytes = 0;
  };
  Batch waiting_;
  std::unordered_map<const TopicReader*, Load> loads_;  // of what waits
  bool news_ = false;
};

}  // namespace roci::services::node
