#include "tests/unit/planner_svc/service/road_planning.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>

namespace roci::planner::testing {
namespace {

namespace topics = services::topics;
using namespace std::chrono_literals;

// A mission whose planner waits 20 s for values and takes 0.5 s for a call.
std::string made_mission(int domain, const std::string& functions) {
  const auto folder = std::filesystem::temp_directory_path() /
                      ("roci_roads_" + std::to_string(::getpid()) + "_" + std::to_string(domain));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "mission.yaml") << "planner: {function_timeout_s: 20, functions: " << functions
                                         << ", simulated: {base_s: 0.5, per_evaluation_s: 0}}\n";
  return folder;
}

v1::FunctionOffer offer() {
  v1::FunctionOffer out;
  out.module_name("roads");
  out.owner("roads_svc");
  out.model_version(7);
  out.functions().resize(1);
  out.functions()[0].name("travel_time");
  out.functions()[0].parameter_types({"place", "place"});
  out.functions()[0].accuracies({v1::ACCURACY_EXACT, v1::ACCURACY_LOWER_BOUND});
  return out;
}

}  // namespace

const std::string kRoadDomain = R"((define (domain roads)
  (:requirements :typing :durative-actions)
  (:types place)
  (:predicates (at ?p - place))
  (:modules (:module roads (:function (travel_time ?from ?to - place))))
  (:durative-action go
    :parameters (?from ?to - place)
    :duration (= ?duration (travel_time ?from ?to))
    :condition (at start (at ?from))
    :effect (and (at start (not (at ?from))) (at end (at ?to)))))
)";

std::string road_problem(const std::string& goal) {
  return "(define (problem trip) (:domain roads)\n  (:objects a b c - place)\n  (:init (at a))\n  (:goal " +
         goal + "))\n";
}

v1::PlanRequest plan_request(const std::string& domain, const std::string& problem) {
  v1::PlanRequest out;
  out.engine("temporal_pddl");
  out.model(domain);
  out.problem_text(problem);
  return out;
}

v1::FunctionReply ten_seconds(const v1::FunctionRequest& request, temporal::Time now) {
  v1::FunctionReply out;
  out.owner("roads_svc");
  out.model_version(7);
  out.computed_us(now.count());
  for (const v1::FunctionBatch& batch : request.batches()) {
    v1::FunctionValues values;
    values.function(batch.function());
    values.accuracy(batch.accuracy());
    values.numbers().assign(batch.tuples().size() / batch.arity(), 10);
    values.outcomes().assign(batch.tuples().size() / batch.arity(), v1::FUNCTION_VALUE);
    out.results().push_back(values);
  }
  return out;
}

std::string steps_of(const v1::Plan& plan) {
  std::string out;
  for (const v1::PlanActivity& activity : plan.activities()) {
    out += (out.empty() ? "" : ", ") + activity.name();
    for (const v1::Property& argument : activity.arguments()) out += " " + argument.value();
  }
  return out;
}

RoadPlanning::RoadPlanning(const RoadVendors& vendors, int domain, bool offered, const std::string& functions)
    : mission_(made_mission(domain, functions)),
      run_({"client", "planner_svc", "roads_svc"}, domain),
      client_(run_.add("client", 1, vendors.client)),
      owner_(run_.add("roads_svc", 1, vendors.owner)),
      planner_(client_, topics::plan_request) {
  services::RunSettings settings;
  settings.mission = mission_;
  settings.run_folder = mission_;
  service_ = make_service(run_.add("planner_svc", 1, vendors.planner), settings);
  if (offered) services::advertise(owner_, topics::function_offer).write(offer());
  owner_answers([this](const v1::FunctionRequest& request, auto responder) {
    responder.reply(ten_seconds(request, owner_.now()));
  });
  services::serve(owner_, topics::function_call, [this](const v1::FunctionRequest& request, auto responder) {
    ++requests_for_values_;
    answer_(request, responder);
  });
  services::subscribe(client_, topics::event, [this](const v1::Event& event) { events_.push_back(event); });
}

RoadPlanning::~RoadPlanning() {
  service_.reset();
  std::filesystem::remove_all(mission_);
}

void RoadPlanning::ask(temporal::Time when, const v1::PlanRequest& request) {
  client_.at(when, [this, request] {
    newest_ = planner_.call(request, "planner_svc", 1000s,
                            [this](const services::CallResult<v1::PlanReply>& result) {
                              replies_.push_back({client_.now(), result});
                            });
  });
}

void RoadPlanning::cancel(temporal::Time when) {
  client_.at(when, [this] { planner_.cancel(newest_); });
}

void RoadPlanning::run_until(temporal::Time end) {
  client_.at(end, [this] { client_.stop(); });
  run_.run();
}

}  // namespace roci::planner::testing
