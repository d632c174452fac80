#include "services/launch/supervisor.hpp"

#include <algorithm>
#include <csignal>
#include <system_error>
#include <utility>

namespace roci::services::launch {

namespace {

constexpr double kLeaveS = 5;      // for services to leave by themselves after the clock's last step
constexpr double kTerminateS = 5;  // from SIGTERM to SIGKILL

}  // namespace

Supervisor::Supervisor(const std::vector<std::string>& services, std::string master, bool master_is_clock,
                       Watchdog watchdog, Hooks hooks, std::uint32_t incarnations)
    : master_(std::move(master)),
      master_is_clock_(master_is_clock),
      watchdog_(std::move(watchdog)),
      hooks_(std::move(hooks)) {
  for (const std::string& name : services) {
    services_[name].incarnation = incarnations;
    services_[name].ran =
        incarnations > 0;  // an earlier launcher has flown the run: its network is out, not missing
  }
}

void Supervisor::start(clock::WallTime now) {
  for (auto& [name, service] : services_) launch(name, service, now);
}

void Supervisor::launch(const std::string& name, Service& service, clock::WallTime now) {
  service.restart.reset();
  service.started = now;
  service.hung_reason.clear();
  service.child = hooks_.start(name, ++service.incarnation);
  watchdog_.started(name, service.incarnation, service.child->pid(), now);
}

void Supervisor::turn(clock::WallTime now) {
  // The master comes first: its end explains those of the others.
  if (const auto master = services_.find(master_); master != services_.end()) look_after(*master, now);
  for (auto& entry : services_) look_after(entry, now);
  kill_hung(now);
  wind_up(now);
}

// Its end is noticed and mended like any other. While the run ends, wind_up() has the last word.
void Supervisor::kill_hung(clock::WallTime now) {
  for (Watchdog::Hung& hung : watchdog_.check(now)) {
    Service& service = services_.at(hung.service);
    if (terminate_at_ || !service.child) continue;
    service.hung_reason = std::move(hung.reason);
    service.child->signal(SIGKILL);
  }
}

void Supervisor::look_after(std::pair<const std::string, Service>& entry, clock::WallTime now) {
  auto& [name, service] = entry;
  if (service.child) {
    if (const auto ending = service.child->ending()) {
      service.child.reset();
      service.ran = service.ran || watchdog_.ran(name);
      watchdog_.ended(name);
      after_end(name, service, *ending, now);
    }
  } else if (service.restart && *service.restart <= now) {
    launch_again(name, service, now);
  }
}

// The machine may have no room for a process for a while; the run does not end for that.
void Supervisor::launch_again(const std::string& name, Service& service, clock::WallTime now) {
  const std::uint32_t incarnation = service.incarnation;
  try {
    launch(name, service, now);
  } catch (const std::system_error& error) {
    service.incarnation = incarnation;
    start_again(name, service, error.what(), RestartPolicy::kHelperPause, now);
  }
}

void Supervisor::after_end(const std::string& name, Service& service, const Ending& ending,
                           clock::WallTime now) {
  const bool clean = ending.exited && ending.code == kServiceStopped;
  if (clean && name == master_ && !terminate_at_) {
    // The others were told by the clock; live ones must be asked.
    terminate_at_ = master_is_clock_ ? now + clock::wall_seconds(kLeaveS) : now;
  }
  if (clean || terminate_at_) return;
  const bool superseded = ending.exited && ending.code == kServiceSuperseded;
  const std::string why = superseded ? "another process of the run has its name" : service.hung_reason;
  const std::string what = to_string(ending) + (why.empty() ? "" : " (" + why + ")");
  if (ending.exited && ending.code == kServiceClockGone)
    return fail(name, "lost the clock of the run", false, now);
  if (ending.exited && ending.code == kServiceBadInput) return fail(name, what, true, now);
  if (ending.exited && ending.code == kServiceNoTransport) {
    if (!service.ran && hooks_.may_be_missed && hooks_.may_be_missed(name))
      return miss(name, service, what, "", now);
    if (!service.ran) return fail(name, what, false, now);
    return start_again(name, service, what + ", as long as its network is out", RestartPolicy::kNetworkPause,
                       now);
  }
  if (name == master_ && master_is_clock_)
    return fail(name, what + "; it is the clock of the run", false, now);
  if (now - service.started >= RestartPolicy::kHealthyAfter) service.missed = false;
  const auto pause = service.policy.died(now - service.started);
  if (!pause && hooks_.may_be_missed && hooks_.may_be_missed(name))
    return miss(name, service, what,
                ", the " + std::to_string(RestartPolicy::kDeathsInARow) + "th time in a row", now);
  if (!pause) {
    return fail(name, what + ", the " + std::to_string(RestartPolicy::kDeathsInARow) + "th time in a row",
                false, now);
  }
  start_again(name, service, what, *pause, now);
}

void Supervisor::start_again(const std::string& name, Service& service, const std::string& what,
                             clock::WallDuration pause, clock::WallTime now) {
  service.restart = now + pause;
  hooks_.on_death(name, what + "; starting it again");
}

void Supervisor::miss(const std::string& name, Service& service, const std::string& what,
                      const std::string& how_often, clock::WallTime now) {
  start_again(name, service, what, RestartPolicy::kHelperPause, now);
  if (std::exchange(service.missed, true) || !hooks_.on_missed) return;
  hooks_.on_missed(name, what + how_often + "; the mission goes on without it");
}

void Supervisor::fail(const std::string& name, std::string what, bool bad_input, clock::WallTime now) {
  hooks_.on_death(name, what);
  failure_ = RunFailure{name, std::move(what), bad_input};
  terminate_at_ = now;
}

void Supervisor::stop(clock::WallTime now) {
  if (terminate_at_ || !services_.contains(master_) || !services_[master_].child) {
    terminate_at_ = now;
    return;
  }
  terminate_at_ = now + clock::wall_seconds(kLeaveS);
  services_[master_].child->signal(SIGTERM);
}

void Supervisor::wind_up(clock::WallTime now) {
  if (!terminate_at_) return;
  for (auto& [name, service] : services_) service.restart.reset();
  if (!kill_at_ && now >= *terminate_at_) {
    signal_all(SIGTERM);
    kill_at_ = now + clock::wall_seconds(kTerminateS);
  }
  if (kill_at_ && now >= *kill_at_) signal_all(SIGKILL);
}

void Supervisor::signal_all(int number) {
  for (auto& [name, service] : services_) {
    if (service.child) service.child->signal(number);
  }
}

bool Supervisor::finished() const {
  return std::ranges::none_of(services_,
                              [](const auto& entry) { return entry.second.child || entry.second.restart; });
}

}  // namespace roci::services::launch
