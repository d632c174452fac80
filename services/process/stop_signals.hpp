// SIGTERM and SIGINT come as a plain function call on a thread of its own, for programs that stop cleanly.
#pragma once

#include <functional>
#include <thread>

namespace roci::services::process {

/// Owns the thread that waits for the signals.
class StopSignals {
 public:
  /// Blocks the signals for all threads that start later, so it must be created before any other thread.
  StopSignals();
  ~StopSignals();
  StopSignals(const StopSignals&) = delete;
  StopSignals& operator=(const StopSignals&) = delete;

  /// Calls `on_stop` for each signal from now on until this object ends.
  void watch(std::function<void()> on_stop);

 private:
  int signals_ = -1;
  int end_ = -1;
  std::thread thread_;
};

}  // namespace roci::services::process
