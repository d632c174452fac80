#include "rehearsal/check/event_codes.hpp"

namespace roci::rehearsal::check {

const std::vector<std::string>& event_codes() {
  // clang-format off
  static const std::vector<std::string> codes = {
      "ack.foreign", "answer.no_room", "calls.damaged", "calls.resumed", "calls.settling", "calls.unwritten", "clock.drift", "clock.offset", "clock.set", "command.epoch_jump",
      "command.foreign", "commander.doubled", "component.lost", "contract.mismatch", "datagram.refused", "disk.full", "disk.room", "epoch.refused",
      "epoch.taken", "executive.resumed", "fact.left_out", "fallback.failed", "goal.accepted",
      "goal.achieved", "goal.dropped", "goal.failed", "goal.merged", "goal.no_room", "goal.recalled",
      "goal.refused", "goal.rejected", "goal.suspected", "goal.weighed", "hazard.refused", "hazard.seen", "image.unreadable", "journal.damaged",
      "journal.diverged", "journal.no_room", "journal.shortened", "journal.waiting", "journal.written", "lead.split",
      "lead.whole", "ledger.unwritten", "map.changed", "map.finding_refused", "map.patch_refused", "map.patch_taken", "map.told", "map.unknown", "model.no_room", "motion.refused",
      "network.accepted", "network.in_force", "network.refused", "observation.malformed", "order.accepted", "order.lost", "order.malformed", "order.no_room", "order.refused",
      "place.unusable", "plan.adopted", "plan.broken", "plan.conflict", "plan.finished", "plan.kept",
      "plan.malformed", "plan.outdated", "plan.refused", "plan.relaunched", "plan.retry", "plan.waits", "plan.wanted",
      "planner.blocked", "planner.cycle", "planner.defect", "planner.measured", "planner.network_damaged",
      "planner.network_unwritten", "planner.no_room", "planner.record_ended", "planner.verdict", "planner.warning", "pose.unusable",
      "recovery.contingency", "recovery.push", "recovery.retry", "reserve.spent", "robot.safe", "robot.safing", "robot.unsafe", "run.foreign", "sample.refused",
      "scenario.as_expected", "scenario.over", "scenario.time-up", "scenario.unexpected", "science.find",
      "science.no_room", "service.died", "service.doubled", "service.found", "service.lost",
      "service.missed", "soil.no_go", "standby.gone", "standby.ready", "timeline.contested", "timeline.no_room",
      "values.outdated",
      "watch.goal", "watch.no_room",
  };
  // clang-format on
  return codes;
}

}  // namespace roci::rehearsal::check
