#include "tests/unit/ground_console/messages.hpp"

namespace roci::console::testing {
namespace {

std::int64_t us(double s) { return s < 0 ? -1 : static_cast<std::int64_t>(s * 1e6); }

v1::PlanActivity activity(const std::string& id, const std::string& name, const std::string& object,
                          double s) {
  v1::PlanActivity out;
  out.id(id);
  out.name(name);
  out.arguments().resize(1);
  out.arguments()[0].name("to");
  out.arguments()[0].value(object);
  out.duration_lower_us(us(s));
  return out;
}

}  // namespace

v1::SampleHeader sent(const std::string& sender, std::uint64_t seq, double s, std::uint32_t incarnation) {
  v1::SampleHeader out;
  out.sender(sender);
  out.incarnation(incarnation);
  out.seq(seq);
  out.stamp_us(us(s));
  return out;
}

v1::GoalStatus goal_status(const std::string& id, v1::GoalState state, std::uint64_t seq,
                           const std::string& reason) {
  v1::GoalStatus out;
  out.header(sent("exec_svc", seq, 10));
  out.issuer("ground");
  out.id(id);
  out.goal_kind("photo");
  out.goal_state(state);
  out.reason(reason);
  return out;
}

v1::Event event(const std::string& text, double s, v1::Severity severity) {
  v1::Event out;
  out.header(sent("exec_svc", 1, s));
  out.severity_level(severity);
  out.code("test");
  out.text(text);
  return out;
}

v1::Observation observation(const std::string& timeline, const std::string& state, std::uint64_t seq) {
  v1::Observation out;
  out.header(sent("sim_svc", seq, 20));
  out.timeline(timeline);
  out.observed().kind(v1::VALUE_STATE);
  out.observed().state(state);
  return out;
}

v1::StepStatus step(const std::string& id, v1::ActivityState state, std::uint64_t seq, double from_s,
                    double started_s, double ended_s) {
  v1::StepStatus out;
  out.header(sent("exec_svc", seq, 10));
  out.activity(id);
  out.state(state);
  out.earliest_start_us(us(from_s));
  out.latest_start_us(-1);
  out.started_us(us(started_s));
  out.ended_us(us(ended_s));
  return out;
}

v1::Goal goal(const std::string& id, const std::string& x, const std::string& y) {
  v1::Goal out;
  out.issuer("ground");
  out.id(id);
  v1::Property first, second;
  first.name("x");
  first.value(x);
  second.name("y");
  second.value(y);
  out.arguments({first, second});
  out.closes_us(us(900));
  return out;
}

v1::Observation number(const std::string& timeline, double value, double s) {
  v1::Observation out;
  out.header(sent("sim_svc", static_cast<std::uint64_t>(s), s));
  out.timeline(timeline);
  out.observed().kind(v1::VALUE_NUMBER);
  out.observed().number(value);
  return out;
}

lib::MissionView flying_mission() {
  lib::MissionView view;
  v1::MissionStatus status;
  status.header(sent("exec_svc", 1, 300));
  status.mission("planetary");
  status.phase(v1::PHASE_EXECUTING);
  status.plan_version(2);
  status.replans(1);
  v1::PredictedWindow window;
  window.timeline("comm.window");
  window.opens_us(us(200));
  window.closes_us(us(260));
  status.windows({window});
  view.take(status);
  view.take(goal("ridge", "30", "40"));
  view.take(goal("far", "900", "none"));  // no place: y is no number
  v1::Hazard rock;
  rock.header(sent("sim_svc", 3, 200));
  rock.x_m(10);
  rock.y_m(25);
  view.take(rock);
  for (int i = 0; i <= 6; ++i) {
    view.take(number("rover.x", 5.0 * i, 100 + 20.0 * i));
    view.take(number("rover.y", i < 4 ? 10.0 : 10.0 * (i - 2), 100 + 20.0 * i));
  }
  view.take(goal_status("ridge", v1::GOAL_PLANNED, 1, "in plan 2"));
  view.take(goal_status("far", v1::GOAL_REJECTED, 2, "outside the map"));
  v1::Plan plan;
  plan.header(sent("exec_svc", 1, 100));
  plan.version(2);
  plan.activities(
      {activity("2.a1", "drive", "place-ridge", 200), activity("2.a2", "take-image", "image-ridge", 40)});
  view.take(plan);
  view.take(step("2.a1", v1::ACTIVITY_SUCCEEDED, 1, 100, 100, 290));
  view.take(step("2.a2", v1::ACTIVITY_RUNNING, 2, 290, 295, -1));
  view.take(observation("rover.nav", "idle-at", 1));
  view.take(observation("rover.camera", "imaging", 2));
  view.take(event("goal ground/ridge accepted", 10));
  view.take(event("plan 1 is broken", 90, v1::SEVERITY_WARNING));
  return view;
}

}  // namespace roci::console::testing
