#include "tests/unit/exec_svc/service/exec_seat.hpp"

#include <unistd.h>

#include <chrono>
#include <fstream>
#include <regex>
#include <sstream>

#include "services/wire/plan_wire.hpp"
#include "tests/unit/exec_svc/planetary_fixture.hpp"

namespace roci::exec::testing {

using goals::GoalRecord;
using journal::Journal;

namespace {

namespace fs = std::filesystem;
namespace topics = services::topics;
using namespace std::chrono_literals;

fs::path made_folder(int domain) {
  const fs::path folder =
      fs::temp_directory_path() / ("roci_exec_" + std::to_string(::getpid()) + "_" + std::to_string(domain));
  fs::remove_all(folder);
  fs::create_directories(folder);
  return folder;
}

// An image for each goal fact of the problem, one after the other.
temporal::FlexiblePlan images_for(const std::string& problem) {
  temporal::FlexiblePlan plan;
  const std::string goal = problem.substr(problem.find("(:goal"));
  const std::regex wanted("\\(sent image-([a-z0-9-]+)\\)");
  for (std::sregex_iterator match(goal.begin(), goal.end(), wanted), end; match != end; ++match) {
    temporal::PlanActivity activity;
    activity.id = "a" + std::to_string(plan.activities.size() + 1);
    activity.name = "take-image";
    activity.arguments = {{"1", "image-" + (*match)[1].str()}, {"2", "place-" + (*match)[1].str()}};
    activity.goals_served = {"ground/" + (*match)[1].str()};
    activity.start_point = plan.point_count++;
    activity.end_point = plan.point_count++;
    activity.duration_lower = activity.duration_upper = temporal::seconds(40);
    if (!plan.activities.empty()) {
      plan.constraints.push_back({plan.activities.back().end_point, activity.start_point,
                                  temporal::ConstraintKind::ordering, temporal::seconds(0.001),
                                  temporal::no_bound});
    }
    plan.activities.push_back(std::move(activity));
  }
  return plan;
}

const char* name_of(v1::GoalState state) {
  constexpr std::array names{"rejected", "pending", "planned", "achieved", "dropped", "failed", "recalled"};
  return names.at(static_cast<std::size_t>(state));
}

// Mission time waits for an executive that was killed to come back.
services::Node& waiting_master(services::SimRun& run, const std::string& vendor) {
  run.master.restart_hold_s = 1000;
  return run.add("sim_svc", 1, vendor);
}

}  // namespace

v1::Goal photo_goal(const std::string& id) {
  v1::Goal out;
  out.issuer("ground");
  out.id(id);
  out.goal_kind("photo");
  out.arguments().resize(2);
  out.arguments()[0].name("x");
  out.arguments()[0].value("110");
  out.arguments()[1].name("y");
  out.arguments()[1].value("60");
  return out;
}

ExecSeat::ExecSeat(const std::string& vendor, const std::string& vendor_of_others, int domain,
                   const std::vector<GoalRecord>& journalled, fs::path mission_folder)
    : folder_(made_folder(domain)),
      mission_(std::move(mission_folder)),
      vendor_(vendor),
      vendor_of_others_(vendor_of_others),
      run_({"sim_svc", "planner_svc", "exec_svc"}, domain),
      robot_(waiting_master(run_, vendor_of_others)),
      goals_(services::advertise(robot_, topics::goal)),
      observations_(services::advertise(robot_, topics::observation)),
      acks_(services::advertise(robot_, topics::command_ack)) {
  serve_plans(run_.add("planner_svc", 1, vendor_of_others));
  services::subscribe(robot_, topics::command, [this](const v1::Command& command) { obey(command); });
  services::subscribe(robot_, topics::goal_status, [this](const v1::GoalStatus& status) {
    statuses.push_back(status.id() + " " + name_of(status.goal_state()) +
                       (status.reason().empty() ? "" : " " + status.reason()));
  });
  services::subscribe(robot_, topics::event,
                      [this](const v1::Event& event) { events.push_back(event.code()); });
  services::subscribe(robot_, topics::plan, [this](const v1::Plan& plan) { plans.push_back(plan); });
  services::subscribe(robot_, topics::mission_status,
                      [this](const v1::MissionStatus& status) { this->mission = status; });
  robot_.at(0s, [this] {
    for (const auto& [timeline, value] : standing_robot()) observe(timeline, value);
  });
  {
    Journal earlier = journal();
    for (const GoalRecord& record : journalled) earlier.put_goal(record);
    earlier.commit();
  }
  start_executive(1);
}

ExecSeat::~ExecSeat() {
  run_.join();
  executive_.reset();
  fs::remove_all(folder_);
}

void ExecSeat::start_executive(std::uint32_t incarnation) {
  services::Node& node = run_.add("exec_svc", incarnation, vendor_);
  services::RunSettings settings;
  settings.mission = mission_;
  settings.run_folder = folder_;
  executive_ = make_service(node, settings);
}

void ExecSeat::kill_executive_at(temporal::Time when) {
  killed_ = true;
  run_.node("exec_svc").at(when, [this] {
    executive_.reset();
    throw services::Crash{};
  });
}

void ExecSeat::kill_planner_at(temporal::Time when, std::function<void(services::Node&)> begun_anew) {
  planner_begun_anew_ = std::move(begun_anew);
  run_.node("planner_svc").at(when, [] { throw services::Crash{}; });
}

void ExecSeat::kill_both_at(temporal::Time when) {
  kill_executive_at(when);
  kill_planner_at(when, [](services::Node&) {});
}

void ExecSeat::serve_plans(services::Node& planner) {
  services::serve(planner, topics::plan_request,
                  [this, &planner](const v1::PlanRequest& request, auto responder) {
                    ++planner_calls;
                    v1::PlanReply reply;
                    reply.verdict_code(v1::VERDICT_SOLVED);
                    reply.solution(services::wire::to_wire(images_for(request.problem_text())));
                    planner.after(500ms, [responder, reply] { responder.reply(reply); });
                  });
}

void ExecSeat::observe(const std::string& timeline, const temporal::Value& value) {
  v1::Observation out;
  out.timeline(timeline);
  out.observed(services::wire::to_wire(value));
  out.sampled_us(robot_.now().count());
  observations_.write(out);
}

void ExecSeat::tell(const std::string& activity, std::uint32_t attempt, v1::CommandStage stage) {
  v1::CommandAck out;
  out.commander("exec_svc");
  if (!commands.empty()) out.epoch(commands.back().epoch());
  out.activity(activity);
  out.attempt(attempt);
  out.stage(stage);
  out.owner(acknowledged_by.empty() ? "sim_svc" : acknowledged_by);
  if (stage != v1::STAGE_UNKNOWN) messages_[{activity, attempt}] = stage;
  acks_.write(out);
}

void ExecSeat::obey(const v1::Command& command) {
  commands.push_back(command);
  if (command.sender_epoch() < held_epoch && command.command_name() != "stop") {
    v1::CommandAck refused;
    refused.commander(command.commander());
    refused.epoch(command.epoch());
    refused.activity(command.activity());
    refused.attempt(command.attempt());
    refused.stage(v1::STAGE_REJECTED);
    refused.owner("sim_svc");
    refused.code("old-epoch");
    refused.newest_epoch(held_epoch);
    refused.refused_epoch(true);
    acks_.write(refused);
    return;
  }
  held_epoch = std::max(held_epoch, command.sender_epoch());
  const std::pair key(command.activity(), command.attempt());
  const auto word = messages_.find(key);
  if (command.action() == v1::COMMAND_QUERY ||
      (command.action() == v1::COMMAND_EXECUTE && word != messages_.end())) {
    tell(command.activity(), command.attempt(), word == messages_.end() ? v1::STAGE_UNKNOWN : word->second);
    return;
  }
  if (command.command_name() == "stop" || command.action() == v1::COMMAND_CANCEL) {
    tell(command.activity(), command.attempt(),
         command.action() == v1::COMMAND_CANCEL ? v1::STAGE_CANCELLED : v1::STAGE_COMPLETED);
    observe("rover.camera", temporal::state("idle"));
    return;
  }
  tell(command.activity(), command.attempt(), v1::STAGE_ACCEPTED);
  observe("rover.camera", temporal::state("imaging"));
  const std::string image = command.arguments().at(0).value();
  robot_.after(40s, [this, image, activity = command.activity(), attempt = command.attempt()] {
    observe("rover.camera", temporal::state("idle"));
    observe("rover.image." + image, temporal::state("sent"));
    tell(activity, attempt, v1::STAGE_COMPLETED);
  });
}

void ExecSeat::send(temporal::Time when, const v1::Goal& goal) {
  robot_.at(when, [this, goal] { goals_.write(goal); });
}

void ExecSeat::run_until(temporal::Time end) {
  robot_.at(end, [this] { robot_.stop(); });
  run_.start();
  if (killed_) run_.wait_for_crash("exec_svc");
  if (planner_begun_anew_) {
    run_.wait_for_crash("planner_svc");
    services::Node& planner = run_.add("planner_svc", 2, vendor_of_others_);
    serve_plans(planner);
    planner_begun_anew_(planner);
    run_.start();
  }
  if (killed_) start_executive(2);
  run_.run();
}

std::string ExecSeat::summary() const {
  std::ostringstream text;
  text << std::ifstream(folder_ / "summary.json").rdbuf();
  return text.str();
}

}  // namespace roci::exec::testing
