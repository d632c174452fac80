#include "dedicated_svc/calls_service.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <system_error>
#include <utility>

#include "core/terrain/way.hpp"
#include "dedicated_svc/limits.hpp"
#include "services/node/make_event.hpp"
#include "services/publisher.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::dedicated {
namespace {

using method_run::Answer;
using services::owner::CommandStatus;
using services::owner::Stage;
using temporal::Value;

std::optional<double> number_of(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return {};
  return number;
}

terrain::Way way_of(const v1::PathReply& reply) {
  terrain::Way way;
  for (const v1::Pose2& one : reply.waypoints()) way.push_back({one.x_m(), one.y_m()});
  return way;
}

// Adds the way and where and how it ends; one without a leg ends as it began.
void add_way(const terrain::Way& way, double first_heading, std::map<std::string, Value>& values) {
  values["way"] = temporal::state(terrain::to_text(way), {});
  values["end_x"] = way.back().x;
  values["end_y"] = way.back().y;
  values["end_heading_rad"] = terrain::heading_at_end(way, first_heading);
}

// Says in words that the map of another robot, on which a path stands, is too old; empty: it is not.
std::string age_fault(const methods::PathCall& call, temporal::Time now) {
  if (call.map_told_s.empty()) return {};
  const auto told = number_of(call.map_told_s);
  if (!told) return "when its map was told is no number: " + call.map_told_s;
  const temporal::Duration age = now - temporal::seconds(*told);
  if (age <= call.map_within) return {};
  return "the newest map that was merged is " + std::to_string(temporal::to_seconds(age)) +
         " s old, and may be " + std::to_string(temporal::to_seconds(call.map_within)) + " s";
}

const char* error_of(v1::MotionOutcome outcome) {
  switch (outcome) {
    case v1::MOTION_FOUND:
      return "";
    case v1::MOTION_UNREACHABLE:
      return "no-path";
    case v1::MOTION_UNKNOWN:
      return "path-unknown";
    default:
      return "path-invalid";
  }
}

Value awaited(const methods::ObserveCall& call) {
  if (call.arguments.empty() && (call.state == "true" || call.state == "false")) return call.state == "true";
  return temporal::state(call.state, call.arguments);
}

Answer answer_of(const CommandStatus& status) {
  Answer answer;
  answer.values = status.results.values;
  answer.energy_j = status.results.energy_j;
  if (status.results.duration) answer.values["duration_s"] = temporal::to_seconds(*status.results.duration);
  if (status.stage == Stage::completed) return answer;
  answer.error = status.code.empty() ? "refused" : status.code;
  answer.reason = status.reason.empty() ? answer.error : answer.error + ", " + status.reason;
  return answer;
}

}  // namespace

Calls::Calls(services::Node& node, CallRecord& record, Spots objects)
    : node_(node),
      record_(record),
      events_(services::advertise(node, services::topics::event)),
      objects_(std::move(objects)),
      commands_(node, record.epoch() + 1,
                [this](const services::commander::Issued& issued) { keep([&] { record_.begin(issued); }); }),
      paths_(services::make_client(node, services::topics::path_request)) {
  services::subscribe(node, services::topics::observation, [this](const v1::Observation& seen) {
    if (observed_.size() >= kTimelines && !observed_.contains(seen.timeline())) return;
    try {
      observed_[seen.timeline()] = services::wire::from_wire(seen.observed());
    } catch (const services::wire::WireError&) {
      return;
    }
    if (on_answer_) look();
  });
}

std::string Calls::activity_of(const services::owner::Request& above, std::uint32_t number) {
  return above.key.commander + "/" + std::to_string(above.key.issued_epoch) + "/" + above.key.activity + "/" +
         std::to_string(number);
}

void Calls::set(const method_run::Ask& ask, const services::owner::Request& above, temporal::Time begun,
                OnAnswer on_answer) {
  call_ = ask.call;
  above_ = above;
  activity_ = activity_of(above, ask.number);
  on_answer_ = std::move(on_answer);
  begun_ = begun;
  timed_out_ = false;
  lacks_pose_ = false;
  ++serial_;
  timer_ = node_.at(temporal::plus(begun, call_.within), [this] { time_out(); });
}

void Calls::begin(const method_run::Ask& ask, const services::owner::Request& above, OnAnswer on_answer) {
  if (ask.number == 1) patient_ = false;
  set(ask, above, node_.now(), std::move(on_answer));
  std::visit([this](const auto& call) { start(call); }, call_.what);
}

void Calls::resume(const method_run::Ask& ask, const services::owner::Request& above, temporal::Time begun,
                   OnAnswer on_answer) {
  patient_ = true;
  set(ask, above, begun, std::move(on_answer));
  const auto* command = std::get_if<methods::CommandCall>(&call_.what);
  if (command && record_.open()) return commands_.adopt(*record_.open(), sent_as(*command), on_command_end());
  std::visit([this](const auto& call) { start(call); }, call_.what);
}

services::commander::Call Calls::sent_as(const methods::CommandCall& call) const {
  return {call.owner, call.robot,         call.subsystem, call.command,     call.arguments,
          activity_,  above_.key.attempt, above_.plan,    above_.latest_end};
}

services::commander::CommandClient::OnEnd Calls::on_command_end() {
  return [this](const CommandStatus& status) {
    Answer result = answer_of(status);
    if (timed_out_ && (status.stage == Stage::cancelled || status.stage == Stage::unknown))
      result.error = "call-timeout", result.reason = "it took longer than it may";
    answer(std::move(result));
  };
}

void Calls::start(const methods::CommandCall& call) { commands_.call(sent_as(call), on_command_end()); }

// After a death poses are heard again, sooner or later.
bool Calls::waits_for_pose(std::initializer_list<const methods::Place*> places) {
  lacks_pose_ = patient_ && std::ranges::any_of(places, [this](const methods::Place* place) {
                  return !place->robot.empty() && !spot_of(*place);
                });
  return lacks_pose_;
}

void Calls::start(const methods::PathCall& call) {
  if (waits_for_pose({&call.from, &call.to})) return;
  const auto from = spot_of(call.from);
  const auto to = spot_of(call.to);
  if (!from || !to) return answer_soon({"no-place", "a place of the path is not known", {}, {}});
  v1::PathRequest request;
  for (const auto& [spot, pose] :
       {std::pair{&*from, &request.origin()}, std::pair{&*to, &request.goal_pose()}}) {
    pose->x_m(spot->x);
    pose->y_m(spot->y);
    pose->heading_rad(spot->heading);
  }
  path_ = paths_.call(request, call.planner, call_.within,
                      [this, serial = serial_](const services::CallResult<v1::PathReply>& result) {
                        if (serial == serial_ && on_answer_) take_path(result);
                      });
}

void Calls::take_path(const services::CallResult<v1::PathReply>& result) {
  if (result.status != services::rpc::CallStatus::ok) return answer({"call-timeout", result.reason, {}, {}});
  const v1::PathReply& reply = result.reply;
  Answer out{error_of(reply.outcome()), reply.reason(), {}, {}};
  out.values = {{"length_m", reply.length_m()},
                {"expected_s", reply.expected_s()},
                {"expected_j", reply.expected_j()},
                {"map_version", static_cast<double>(reply.map_version())}};
  if (reply.waypoints().size() > 1) {
    out.values["next_x"] = reply.waypoints()[1].x_m();
    out.values["next_y"] = reply.waypoints()[1].y_m();
  }
  const auto& call = std::get<methods::PathCall>(call_.what);
  if (const std::string fault = age_fault(call, node_.now()); out.error.empty() && !fault.empty())
    return answer({"map-too-old", fault, std::move(out.values), {}});
  const terrain::Way way = way_of(reply);
  if (!std::ranges::all_of(way, [](terrain::Point p) { return std::isfinite(p.x) && std::isfinite(p.y); }))
    return answer({error_of(v1::MOTION_INVALID), "its way-points are no finite numbers", {}, {}});
  if (out.error.empty() && !way.empty() && way.size() <= kWayPoints)
    add_way(terrain::cut_short(way, call.short_m), reply.waypoints()[0].heading_rad(), out.values);
  answer(std::move(out));
}

void Calls::start(const methods::TransformCall& call) {
  const methods::Place origin{"", call.robot, "", ""};
  if (waits_for_pose({&origin, &call.place})) return;
  const auto robot = spot_of(origin);
  const auto place = spot_of(call.place);
  if (!robot || !place)
    return answer_soon({"no-pose", "a pose was never observed, or a place is unknown", {}, {}});
  const double dx = place->x - robot->x, dy = place->y - robot->y;
  const double heading = dx == 0 && dy == 0 ? robot->heading : std::atan2(dy, dx);
  Answer out;
  out.values = {{"x", std::cos(robot->heading) * dx + std::sin(robot->heading) * dy},
                {"y", -std::sin(robot->heading) * dx + std::cos(robot->heading) * dy},
                {"bearing_rad", std::remainder(heading - robot->heading, 2 * M_PI)},
                {"range_m", std::hypot(dx, dy)},
                {"heading_rad", heading},
                {"world_x", place->x},
                {"world_y", place->y}};
  answer_soon(std::move(out));
}

void Calls::start(const methods::ObserveCall&) { look(); }

void Calls::start(const methods::WaitCall& call) {
  answer_after(std::max(temporal::Duration(0), temporal::plus(begun_, call.time) - node_.now()), {});
}

// What is awaited may be so already, or become so by any observation.
void Calls::look() {
  if (std::exchange(lacks_pose_, false))
    return std::visit([this](const auto& one) { start(one); }, call_.what);
  const auto* call = std::get_if<methods::ObserveCall>(&call_.what);
  if (!call) return;
  const auto seen = observed_.find(call->timeline);
  if (seen == observed_.end()) return;
  if (!call->state.empty() && seen->second != awaited(*call)) return;
  Answer out;
  if (std::holds_alternative<double>(seen->second)) out.values["value"] = seen->second;
  answer_soon(std::move(out));
}

void Calls::time_out() {
  timer_.reset();
  timed_out_ = true;
  break_off();
}

void Calls::break_off() {
  if (!on_answer_) return;
  lacks_pose_ = false;
  if (std::holds_alternative<methods::CommandCall>(call_.what))
    return commands_.cancel(activity_, above_.key.attempt);
  if (std::holds_alternative<methods::PathCall>(call_.what)) paths_.cancel(path_);
  answer_soon({timed_out_ ? "call-timeout" : "cancelled", "it was awaited no longer", {}, {}});
}

void Calls::answer_after(temporal::Duration wait, Answer result) {
  node_.after(wait, [this, serial = serial_, result = std::move(result)] {
    if (serial == serial_ && on_answer_) answer(result);
  });
}

void Calls::answer(Answer result) {
  if (timer_) node_.cancel(*std::exchange(timer_, std::nullopt));
  std::exchange(on_answer_, nullptr)(result);
}

void Calls::settle(std::function<void()> settled) {
  if (!record_.open()) return settled();
  commands_.settle(*record_.open(), [this, settled = std::move(settled)](const CommandStatus&) {
    keep([this] { record_.end(); });
    settled();
  });
}

// A robot that can still be commanded beats one that cannot.
void Calls::keep(const std::function<void()>& write) try { write(); } catch (const std::system_error& error) {
  events_.write(services::node::make_event(v1::SEVERITY_WARNING, "calls.unwritten", error.what()));
}

std::optional<double> Calls::number(const std::string& timeline) const {
  const auto seen = observed_.find(timeline);
  const double* number = seen == observed_.end() ? nullptr : std::get_if<double>(&seen->second);
  return number ? std::optional(*number) : std::nullopt;
}

std::optional<Spot> Calls::spot_of(const methods::Place& place) const {
  if (!place.object.empty()) {
    const auto found = objects_.find(place.object);
    return found == objects_.end() ? std::nullopt : std::optional(found->second);
  }
  if (!place.robot.empty()) {
    const auto x = number(place.robot + ".x"), y = number(place.robot + ".y");
    const auto heading = number(place.robot + ".heading");
    if (!x || !y || !heading) return {};
    return Spot{*x + std::cos(*heading) * place.ahead_m - std::sin(*heading) * place.left_m,
                *y + std::sin(*heading) * place.ahead_m + std::cos(*heading) * place.left_m, *heading};
  }
  const auto x = number_of(place.x), y = number_of(place.y);
  if (!x || !y) return {};
  return Spot{*x, *y, 0};
}

}  // namespace roci::dedicated
