// The planner's service between a client and the owner of an external function, on a world of three places
// with roads between them: how long a road takes, only the owner knows.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "planner_svc/planner_service.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::planner::testing {

struct RoadVendors {
  std::string client = "inproc";
  std::string planner = "inproc";
  std::string owner = "inproc";
};

// By name: one transport for all, and two vendors at once.
inline const std::vector<std::pair<const char*, RoadVendors>> kRoadTransports = {
    {"inproc", {}},
    {"fastdds", {"fastdds", "fastdds", "fastdds"}},
    {"cyclonedds", {"cyclonedds", "cyclonedds", "cyclonedds"}},
    {"mixed", {"fastdds", "cyclonedds", "fastdds"}}};

// (:modules (:module roads …)) stands in line 5.
extern const std::string kRoadDomain;
std::string road_problem(const std::string& goal = "(at c)");
v1::PlanRequest plan_request(const std::string& domain, const std::string& problem);

// An answer of roads_svc, map version 7: ten seconds for every tuple, in the accuracy that is asked for.
v1::FunctionReply ten_seconds(const v1::FunctionRequest& request, temporal::Time now);

// "go a c, …": what a plan does, in the order of its activities.
std::string steps_of(const v1::Plan& plan);

struct TimedReply {
  temporal::Time time{0};
  services::CallResult<v1::PlanReply> result;
};

class RoadPlanning {
 public:
  using Answer = std::function<void(const v1::FunctionRequest&, services::Responder<v1::FunctionReply>)>;

  // Under the simulated clock: "client" is its master; roads_svc offers module roads if `offered`, with lower
  // bounds. `functions`: as in mission.yaml, and what may stand behind it there.
  explicit RoadPlanning(const RoadVendors& vendors = {}, int domain = services::next_domain(),
                        bool offered = true, const std::string& functions = "eager");
  ~RoadPlanning();

  // From now on the owner answers so.
  void owner_answers(Answer answer) { answer_ = std::move(answer); }
  void ask(temporal::Time when, const v1::PlanRequest& request);
  // The newest call of then.
  void cancel(temporal::Time when);
  // Until `end`; mission time only.
  void run_until(temporal::Time end);

  services::Node& owner() { return owner_; }
  services::Node& client() { return client_; }
  services::SimRun& run() { return run_; }
  std::filesystem::path run_folder() const { return mission_; }
  int requests_for_values() const { return requests_for_values_; }
  const std::vector<TimedReply>& replies() const { return replies_; }
  const std::vector<v1::Event>& events() const { return events_; }

 private:
  std::string mission_;
  services::SimRun run_;
  services::Node& client_;
  services::Node& owner_;
  services::Client<v1::PlanRequest, v1::PlanReply> planner_;
  std::unique_ptr<services::Service> service_;
  Answer answer_;
  int requests_for_values_ = 0;
  services::rpc::CallId newest_ = 0;
  std::vector<TimedReply> replies_;
  std::vector<v1::Event> events_;
};

}  // namespace roci::planner::testing
