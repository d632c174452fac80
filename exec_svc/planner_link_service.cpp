#include "exec_svc/planner_link_service.hpp"

#include <algorithm>
#include <utility>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/run_files_service.hpp"
#include "exec_svc/wire_service.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::exec {

using reactor::PlanReply;
using reactor::ReactorOutputs;
using temporal::Verdict;

namespace {

constexpr char kPlanner[] = "planner_svc";

std::string planner_of(const mission::MissionModel& mission, const services::RunSettings& settings) {
  if (!mission.planner.service.empty()) return mission.planner.service;
  const std::string serving = services_of(settings).serving(kPlanner, mission.role.robot);
  return serving.empty() ? kPlanner : serving;
}

}  // namespace

PlannerLink::PlannerLink(services::Node& node, const services::RunSettings& settings,
                         const mission::MissionModel& mission, journal::Journal& journal,
                         std::function<void(PlanReply)> take)
    : mission_(mission),
      journal_(journal),
      take_(std::move(take)),
      service_(planner_of(mission, settings)),
      client_(node, services::topics::plan_request),
      slowest_call_s_(temporal::to_seconds(temporal::Duration(journal.number("slowest_call_us", 0)))),
      peak_kib_(static_cast<std::uint32_t>(journal.number("planner_peak_kb", 0))) {}

void PlannerLink::send(const ReactorOutputs& out) {
  if (out.cancelled_call && call_ == *out.cancelled_call) client_.cancel(sent_);
  if (!out.call) return;
  call_ = out.call->id;
  sent_ = client_.call(
      to_wire(*out.call, mission_), service_, mission_.planner.reply_timeout,
      [this, id = call_](const services::CallResult<v1::PlanReply>& result) { take(id, result); });
}

void PlannerLink::take(std::uint64_t call, const services::CallResult<v1::PlanReply>& result) {
  PlanReply reply;
  reply.call = call;
  reply.verdict =
      result.status == services::rpc::CallStatus::cancelled ? Verdict::cancelled : Verdict::no_reply;
  reply.reason = result.reason;
  if (result.status == services::rpc::CallStatus::ok) {
    slowest_call_s_ = std::max(slowest_call_s_, result.reply.statistics().wall_s());
    peak_kib_ = std::max(peak_kib_, result.reply.statistics().peak_rss_kb());
    journal_.set_number("slowest_call_us", temporal::seconds(slowest_call_s_).count());
    journal_.set_number("planner_peak_kb", peak_kib_);
    try {
      reply = from_wire(call, result.reply);
    } catch (const services::wire::WireError& error) {
      reply.verdict = Verdict::crashed;
      reply.reason = error.what();
    }
  }
  take_(std::move(reply));
}

}  // namespace roci::exec
