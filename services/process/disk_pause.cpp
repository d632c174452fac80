#include "services/process/disk_pause.hpp"

#include <poll.h>

#include <algorithm>
#include <utility>

#include "services/node.hpp"
#include "services/node/node_impl.hpp"

namespace roci::services::process {
namespace {

constexpr int kFirstMs = 100;
constexpr int kLongestMs = 1000;
constexpr int kNotifyMs = 200;

}  // namespace

DiskPause::DiskPause(Node& node)
    : DiskPause([&node] {
        node.impl().loop->beat();
        node.impl().announce_turn();
      }) {}

bool DiskPause::wait() {
  const bool first = waits_ == 0;
  if (first) begun_ = clock::wall_now();
  int left = std::min(kFirstMs << std::min(waits_++, 4), kLongestMs);
  for (; left > 0; left -= kNotifyMs) {
    if (notify_) notify_();
    poll(nullptr, 0, std::min(left, kNotifyMs));
  }
  return first;
}

double DiskPause::over() {
  waits_ = 0;
  return std::chrono::duration<double>(clock::wall_now() - begun_).count();
}

}  // namespace roci::services::process
