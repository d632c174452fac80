// SIGTERM and SIGINT come as a plain function call on a thread of its own, for programs that stop cleanly.
#pragma once

#include <functional>
#include <mutex>
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

  /// Calls `on_stop` for each signal from now on until this object ends or forget() is called; what an earlier watch()
  /// asked for is forgotten.
  void watch(std::function<void()> on_stop);
  /// Guarantees, when it returns, that no call is under way and none will come, so that what `on_stop` refers to may
  /// end. A later signal changes nothing.
  void forget();

 private:
  void wait();

  int signals_ = -1;
  int end_ = -1;
  std::mutex mutex_;
  std::function<void()> on_stop_;
  std::thread thread_;
};

/// Watches for as long as it lives; it must end before what `on_stop` refers to.
class StopWatch {
 public:
  StopWatch(StopSignals& signals, std::function<void()> on_stop) : signals_(signals) {
    signals_.watch(std::move(on_stop));
  }
  ~StopWatch() { signals_.forget(); }
  StopWatch(const StopWatch&) = delete;
  StopWatch& operator=(const StopWatch&) = delete;

 private:
  StopSignals& signals_;
};

}  // namespace roci::services::process
