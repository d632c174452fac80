#include "ground_console/lib/repairs.hpp"

#include <algorithm>

#include "ground_console/lib/limits.hpp"

namespace roci::console::lib {
namespace {

template <class Sample>
Repairs::Key key_of(const Sample& sample) {
  return {sample.commander(), sample.epoch(), sample.activity(), sample.attempt()};
}

bool is_last(v1::CommandStage stage) {
  return stage == v1::STAGE_REJECTED || stage == v1::STAGE_COMPLETED || stage == v1::STAGE_FAILED ||
         stage == v1::STAGE_CANCELLED;
}

}  // namespace

const char* name_of(Repair::State state) {
  switch (state) {
    case Repair::State::under_way:
      return "under way";
    case Repair::State::mended:
      return "mended";
    case Repair::State::failed:
      return "failed";
  }
  return "unknown";
}

double share_used(const Repair& repair, std::int64_t now_us) {
  if (repair.latest_end_us < 0) return -1;
  const std::int64_t until = repair.state == Repair::State::under_way ? now_us : repair.ended_us;
  const auto allowed = static_cast<double>(std::max<std::int64_t>(1, repair.latest_end_us - repair.since_us));
  return static_cast<double>(std::max<std::int64_t>(0, until - repair.since_us)) / allowed;
}

bool Repairs::take(const v1::Command& command) {
  if (command.action() != v1::COMMAND_EXECUTE) return true;
  const Key key = key_of(command);
  if (asked_.size() >= kEntries && !asked_.contains(key)) return false;
  asked_[key] = {command.robot(), command.latest_end_us()};
  return true;
}

bool Repairs::take(const v1::CommandAck& word) {
  const Key key = key_of(word);
  const auto known = repairs_.find(key);
  if (is_last(word.stage())) {
    asked_.erase(key);
    if (known == repairs_.end() || known->second.state != Repair::State::under_way) return true;
    Repair& repair = known->second;
    const bool mended = word.stage() == v1::STAGE_COMPLETED;
    repair.state = mended ? Repair::State::mended : Repair::State::failed;
    repair.ended_us = word.header().stamp_us();
    if (!mended) repair.end = word.code() + (word.reason().empty() ? "" : ": " + word.reason());
    return true;
  }
  if (word.stage() != v1::STAGE_ACCEPTED || word.code() != "repairing") return true;
  if (known != repairs_.end()) {
    Repair& repair = known->second;
    if (repair.state != Repair::State::under_way || repair.error == word.reason()) return true;
    repair.error = word.reason();
    ++repair.times;
    return true;
  }
  if (repairs_.size() >= kEntries) return false;
  Repair& repair = repairs_[key];
  repair.owner = word.owner();
  repair.robot = word.header().robot();
  repair.commander = word.commander();
  repair.activity = word.activity();
  repair.error = word.reason();
  repair.since_us = word.header().stamp_us();
  if (const auto asked = asked_.find(key); asked != asked_.end()) {
    repair.latest_end_us = asked->second.latest_end_us;
    if (repair.robot.empty()) repair.robot = asked->second.robot;
  }
  return true;
}

}  // namespace roci::console::lib
