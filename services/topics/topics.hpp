// The one table of topics: type, name, QoS, whether the topic takes part in the simulated clock's barrier, and whom it
// reaches: everyone of the run, the services of one robot, or the team (transport/scope.hpp), and how large a sample
// may be (transport/payload_limit.hpp). Clocked types carry a SampleHeader named `header`, which the node fills in.
#pragma once

#include "roci_idl/clock.h"
#include "roci_idl/command.h"
#include "roci_idl/executed.h"
#include "roci_idl/function.h"
#include "roci_idl/goal.h"
#include "roci_idl/health.h"
#include "roci_idl/map.h"
#include "roci_idl/motion.h"
#include "roci_idl/network.h"
#include "roci_idl/order.h"
#include "roci_idl/outlook.h"
#include "roci_idl/plan.h"
#include "roci_idl/planner.h"
#include "roci_idl/rpc.h"
#include "roci_idl/standby.h"
#include "services/transport/payload_limit.hpp"
#include "services/transport/qos.hpp"
#include "services/transport/scope.hpp"

namespace roci::services::topics {
/// Describes a topic of samples of type T.
template <class T>
struct Topic {
  const char* name;
  const char* type_name;
  transport::Qos qos;
  transport::Clocking clocking;
  transport::Scope scope;
  transport::PayloadLimit limit;
};

using enum transport::Clocking;
using enum transport::Scope;
using transport::PayloadLimit;
using transport::Qos;

// clang-format off

inline constexpr Topic<v1::ClockReady>    clock_ready   {"roci/clock/ready",      "roci::v1::ClockReady",    Qos::state, wall, everyone, PayloadLimit::page};
inline constexpr Topic<v1::ClockStep>     clock_step    {"roci/clock/step",       "roci::v1::ClockStep",     Qos::state, wall, everyone, PayloadLimit::batch};
inline constexpr Topic<v1::ClockDone>     clock_done    {"roci/clock/done",       "roci::v1::ClockDone",     Qos::state, wall, everyone, PayloadLimit::batch};
inline constexpr Topic<v1::Heartbeat>     heartbeat     {"roci/heartbeat",        "roci::v1::Heartbeat",     Qos::state, wall, everyone, PayloadLimit::word};
inline constexpr Topic<v1::TimeProbe>     time_probe    {"roci/clock/probe",      "roci::v1::TimeProbe",     Qos::stream, wall, everyone, PayloadLimit::word};

inline constexpr Topic<v1::LeaseMessage>  exec_member   {"roci/exec/member",      "roci::v1::LeaseMessage",  Qos::state, wall, robot, PayloadLimit::word};
inline constexpr Topic<v1::JournalChunk>  exec_journal  {"roci/exec/journal",     "roci::v1::JournalChunk",  Qos::request, wall, robot, PayloadLimit::journal};
inline constexpr Topic<v1::LeaseRequest>  lease_request {"roci/lease/request",    "roci::v1::LeaseRequest",  Qos::state, wall, robot, PayloadLimit::word};
inline constexpr Topic<v1::LeaseState>    lease_state   {"roci/lease/state",      "roci::v1::LeaseState",    Qos::state, wall, robot, PayloadLimit::word};
inline constexpr Topic<v1::GoalHandOver>  goal_hand_over{"roci/exec/goal",        "roci::v1::GoalHandOver",  Qos::state, wall, robot, PayloadLimit::page};

inline constexpr Topic<v1::Event>         event         {"roci/event",            "roci::v1::Event",         Qos::event, clocked, everyone, PayloadLimit::page};
inline constexpr Topic<v1::Goal>          goal          {"roci/goal",             "roci::v1::Goal",          Qos::state, clocked, team, PayloadLimit::word};
inline constexpr Topic<v1::GoalStatus>    goal_status   {"roci/goal/status",      "roci::v1::GoalStatus",    Qos::state, clocked, team, PayloadLimit::page};
inline constexpr Topic<v1::Command>       command       {"roci/command",          "roci::v1::Command",       Qos::request, clocked, robot, PayloadLimit::page};
inline constexpr Topic<v1::CommandAck>    command_ack   {"roci/command/ack",      "roci::v1::CommandAck",    Qos::state, clocked, robot, PayloadLimit::page};
inline constexpr Topic<v1::Observation>   observation   {"roci/observation",      "roci::v1::Observation",   Qos::state, clocked, robot, PayloadLimit::word};
inline constexpr Topic<v1::DataProduct>   data_product  {"roci/product",          "roci::v1::DataProduct",   Qos::state, clocked, team, PayloadLimit::batch};
inline constexpr Topic<v1::Hazard>        hazard        {"roci/hazard",           "roci::v1::Hazard",        Qos::state, clocked, team, PayloadLimit::word};
inline constexpr Topic<v1::Plan>          plan          {"roci/plan",             "roci::v1::Plan",          Qos::state, clocked, robot, PayloadLimit::plan};
inline constexpr Topic<v1::ExecutedPlan>  executed_plan {"roci/plan/executed",    "roci::v1::ExecutedPlan",  Qos::state, clocked, robot, PayloadLimit::plan};
inline constexpr Topic<v1::StepStatus>    step_status   {"roci/plan/step",        "roci::v1::StepStatus",    Qos::state, clocked, robot, PayloadLimit::page};
inline constexpr Topic<v1::MissionStatus> mission_status{"roci/mission",          "roci::v1::MissionStatus", Qos::state, clocked, team, PayloadLimit::page};
inline constexpr Topic<v1::FunctionOffer> function_offer{"roci/function/offer",   "roci::v1::FunctionOffer", Qos::state, clocked, robot, PayloadLimit::page};

// Orders from the ground, and open decisions of the running plan with their answers.
inline constexpr Topic<v1::Order>         order         {"roci/order",            "roci::v1::Order",         Qos::state, clocked, robot, PayloadLimit::batch};
inline constexpr Topic<v1::OrderStatus>   order_status  {"roci/order/status",     "roci::v1::OrderStatus",   Qos::state, clocked, robot, PayloadLimit::page};
inline constexpr Topic<v1::Decision>      decision      {"roci/decision",         "roci::v1::Decision",      Qos::state, clocked, robot, PayloadLimit::page};
inline constexpr Topic<v1::DecisionAnswer>  decision_answer {"roci/decision/answer",  "roci::v1::DecisionAnswer",  Qos::state, clocked, robot, PayloadLimit::word};
inline constexpr Topic<v1::DecisionReceipt> decision_receipt{"roci/decision/receipt", "roci::v1::DecisionReceipt", Qos::state, clocked, robot, PayloadLimit::page};

// Task networks and values of their parameters from the ground, for an engine that plans all the time.
inline constexpr Topic<v1::NetworkOrder>  network_order {"roci/network/order",    "roci::v1::NetworkOrder",  Qos::state, clocked, robot, PayloadLimit::batch};
inline constexpr Topic<v1::NetworkStatus> network_status{"roci/network/status",   "roci::v1::NetworkStatus", Qos::state, clocked, robot, PayloadLimit::page};

// What such an engine expects of its plan: data and their downlinks, utility, energy, the subway map.
inline constexpr Topic<v1::DownlinkSchedule> downlink_schedule{"roci/downlink/schedule", "roci::v1::DownlinkSchedule", Qos::state, clocked, robot, PayloadLimit::batch};
inline constexpr Topic<v1::MissionOutlook> mission_outlook{"roci/mission/outlook", "roci::v1::MissionOutlook",  Qos::state, clocked, robot, PayloadLimit::batch};

// What a robot finds out about the terrain, and what robots tell each other of it.
inline constexpr Topic<v1::TerrainFinding> terrain_finding{"roci/terrain/finding",  "roci::v1::TerrainFinding", Qos::state, clocked, robot, PayloadLimit::word};
inline constexpr Topic<v1::MapPatch>      map_patch     {"roci/map/patch",        "roci::v1::MapPatch",      Qos::state, clocked, team, PayloadLimit::page};
inline constexpr Topic<v1::KnownMap>      known_map     {"roci/map/known",        "roci::v1::KnownMap",      Qos::state, clocked, robot, PayloadLimit::page};

// An engine that plans all the time uses these.
inline constexpr Topic<v1::PlanDelta>     plan_delta    {"roci/planner/delta",    "roci::v1::PlanDelta",     Qos::request, clocked, robot, PayloadLimit::plan};
inline constexpr Topic<v1::PlanReceipt>   plan_receipt  {"roci/planner/receipt",  "roci::v1::PlanReceipt",   Qos::state, clocked, robot, PayloadLimit::page};

// Every procedure below uses this.
inline constexpr Topic<v1::CallCancel>    call_cancel   {"roci/call/cancel",      "roci::v1::CallCancel",    Qos::request, clocked, robot, PayloadLimit::word};

/// A remote procedure is a pair of topics with the DDS-RPC headers.
template <class Request, class Reply>
struct Procedure {
  Topic<Request> request;
  Topic<Reply> reply;
};

inline constexpr Procedure<v1::PlanRequest, v1::PlanReply> plan_request{
    {"roci/planner/request", "roci::v1::PlanRequest", Qos::request, clocked, robot, PayloadLimit::plan},
    {"roci/planner/reply", "roci::v1::PlanReply", Qos::request, clocked, robot, PayloadLimit::plan}};
inline constexpr Procedure<v1::FunctionRequest, v1::FunctionReply> function_call{
    {"roci/function/request", "roci::v1::FunctionRequest", Qos::request, clocked, robot, PayloadLimit::batch},
    {"roci/function/reply", "roci::v1::FunctionReply", Qos::request, clocked, robot, PayloadLimit::batch}};
inline constexpr Procedure<v1::PathRequest, v1::PathReply> path_request{
    {"roci/path/request", "roci::v1::PathRequest", Qos::request, clocked, robot, PayloadLimit::word},
    {"roci/path/reply", "roci::v1::PathReply", Qos::request, clocked, robot, PayloadLimit::batch}};
inline constexpr Procedure<v1::ArmMotionRequest, v1::ArmMotionReply> arm_motion{
    {"roci/arm/request", "roci::v1::ArmMotionRequest", Qos::request, clocked, robot, PayloadLimit::word},
    {"roci/arm/reply", "roci::v1::ArmMotionReply", Qos::request, clocked, robot, PayloadLimit::batch}};

// clang-format on

}  // namespace roci::services::topics
