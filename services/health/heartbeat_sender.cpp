#include "services/health/heartbeat_sender.hpp"

#include <unistd.h>

#include <array>
#include <fstream>
#include <utility>

namespace roci::services::health {
namespace {

constexpr double kPeriodS = 0.25;

std::string host_name() {
  std::array<char, 256> name{};
  if (gethostname(name.data(), name.size() - 1) != 0) return "unknown";
  return name.data();
}

std::uint32_t resident_kb() {
  std::ifstream statm("/proc/self/statm");
  std::uint64_t total = 0;
  std::uint64_t resident = 0;
  statm >> total >> resident;
  return static_cast<std::uint32_t>(resident * static_cast<std::uint64_t>(sysconf(_SC_PAGESIZE)) / 1024);
}

}  // namespace

HeartbeatSender::HeartbeatSender(v1::Heartbeat identity, Send send)
    : send_(std::move(send)), beat_(std::move(identity)) {
  beat_.host(host_name());
  beat_.process_id(getpid());
}

void HeartbeatSender::beat(clock::WallTime now, bool degraded) {
  ++turns_;
  if (now < next_) return;
  next_ = now + clock::wall_seconds(kPeriodS);
  send(degraded ? v1::SERVICE_DEGRADED : v1::SERVICE_RUNNING);
}

void HeartbeatSender::leave() { send(v1::SERVICE_STOPPING); }

void HeartbeatSender::send(v1::ServiceState state) {
  beat_.progress(turns_);
  beat_.state(state);
  beat_.resident_kb(resident_kb());
  send_(beat_);
}

}  // namespace roci::services::health
