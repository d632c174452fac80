#include "sim_svc/run_end_service.hpp"

#include <algorithm>
#include <utility>

namespace roci::sim {

namespace {

// So many executives are counted: one for each robot, ten times over. Beyond them nobody keeps a run open.
constexpr std::size_t kExecutives = 256;
constexpr temporal::Duration kFarewell = std::chrono::seconds(1);
// A peer that hung is found again within one or two seconds; then its components are observed.
constexpr double kReturnS = 5;

}  // namespace

RunEnd::RunEnd(services::Node& node, std::function<bool()> nothing_to_come, std::function<void()> end)
    : node_(node), nothing_to_come_(std::move(nothing_to_come)), end_(std::move(end)) {
  if (node.options().clock != services::clock::ClockMode::live) return;
  node.on_turn([this] {
    if (awaited_until_) check();
  });
}

RunEnd::MissionState RunEnd::mission_state_of(const v1::MissionStatus& status) {
  if (!status.outcome().empty())
    return status.phase() == v1::PHASE_SAFE ? MissionState::made_safe : MissionState::over;
  const bool idle = status.phase() == v1::PHASE_IDLE && status.goals_open() == 0 &&
                    status.goals_achieved() + status.goals_dropped() + status.goals_failed() == 0;
  return idle ? MissionState::without_goals : MissionState::open;
}

void RunEnd::note(const v1::MissionStatus& status) {
  if (executives_.size() >= kExecutives && !executives_.contains(status.executive())) return;
  executives_[status.executive()] = mission_state_of(status);
  check();
}

// What is on its way to Earth still arrives.
void RunEnd::check() {
  const bool ended = over() && nothing_to_come_();
  if (!ended) awaited_until_.reset();
  const bool through = ended && !may_be_heard_again();
  if (through == farewell_.has_value()) return;
  if (through) {
    farewell_ = node_.after(kFarewell, end_);
  } else {
    node_.cancel(*std::exchange(farewell_, std::nullopt));
  }
}

// Some executive had goals, and none has open ones.
bool RunEnd::over() const {
  const auto any_is = [this](MissionState state) {
    return std::ranges::any_of(executives_, [&](const auto& one) { return one.second == state; });
  };
  return !any_is(MissionState::open) && (any_is(MissionState::over) || any_is(MissionState::made_safe));
}

bool RunEnd::may_be_heard_again() {
  const bool made_safe =
      std::ranges::any_of(executives_, [](const auto& one) { return one.second == MissionState::made_safe; });
  if (!made_safe || node_.options().clock != services::clock::ClockMode::live) return false;
  const auto now = services::clock::wall_now();
  if (!awaited_until_) awaited_until_ = now + services::clock::wall_seconds(kReturnS);
  return now < *awaited_until_;
}

}  // namespace roci::sim
