#include "services/process/stop_signals.hpp"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdint>
#include <system_error>
#include <utility>

namespace roci::services::process {

StopSignals::StopSignals() {
  sigset_t set;
  sigemptyset(&set);
  sigaddset(&set, SIGTERM);
  sigaddset(&set, SIGINT);
  pthread_sigmask(SIG_BLOCK, &set, nullptr);
  signals_ = signalfd(-1, &set, SFD_CLOEXEC | SFD_NONBLOCK);
  end_ = eventfd(0, EFD_CLOEXEC);
  if (signals_ < 0 || end_ < 0) throw std::system_error(errno, std::generic_category(), "signalfd");
}

StopSignals::~StopSignals() {
  if (thread_.joinable()) {
    const std::uint64_t one = 1;
    if (write(end_, &one, sizeof one) == sizeof one) thread_.join();
  }
  close(end_);
  close(signals_);
}

void StopSignals::wait() {
  std::array<pollfd, 2> files{{{signals_, POLLIN, 0}, {end_, POLLIN, 0}}};
  while (poll(files.data(), files.size(), -1) >= 0) {
    if (files[1].revents != 0) return;
    signalfd_siginfo info{};
    if (read(signals_, &info, sizeof info) != sizeof info) continue;
    const std::scoped_lock lock(mutex_);
    if (on_stop_) on_stop_();
  }
}

void StopSignals::watch(std::function<void()> on_stop) {
  {
    const std::scoped_lock lock(mutex_);
    on_stop_ = std::move(on_stop);
  }
  if (!thread_.joinable()) thread_ = std::thread([this] { wait(); });
}

void StopSignals::forget() {
  const std::scoped_lock lock(mutex_);
  on_stop_ = nullptr;
}

}  // namespace roci::services::process
