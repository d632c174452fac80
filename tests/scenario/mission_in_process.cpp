#include "tests/scenario/mission_in_process.hpp"

#include <unistd.h>

#include <fstream>

#include "rehearsal/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
namespace topics = services::topics;

constexpr char kMission[] = ROCI_SOURCE_DIR "/missions/planetary";

fs::path made_folder() {
  static int last = 0;
  const fs::path folder = fs::temp_directory_path() /
                          ("roci_mission_" + std::to_string(::getpid()) + "_" + std::to_string(++last));
  fs::create_directories(folder / "run");
  return folder;
}

// The master of the clock stands first, the ground last.
std::vector<std::string> roster() {
  const auto crew = rehearsal::crew_of(kMission);
  std::vector<std::string> out{crew.back().name};
  for (const mission::ServiceEntry& entry : crew)
    if (entry.name != out.front()) out.push_back(entry.name);
  out.emplace_back("ground");
  return out;
}

}  // namespace

MissionInProcess::MissionInProcess(const std::map<std::string, std::string>& changed, std::uint64_t seed)
    : folder_(made_folder()),
      run_folder_(folder_ / "run"),
      run_(roster()),
      ground_(run_.add("ground")),
      goals_out_(services::advertise(ground_, topics::goal)) {
  fs::copy(ROCI_SOURCE_DIR "/missions/planetary", folder_ / "planetary", fs::copy_options::recursive);
  for (const auto& [name, text] : changed) std::ofstream(folder_ / "planetary" / name) << text;
  services::RunSettings settings;
  settings.mission = folder_ / "planetary";
  settings.run_folder = run_folder_;
  settings.seed = seed;
  for (const mission::ServiceEntry& entry : rehearsal::crew_of(kMission))
    services_.push_back(rehearsal::make_of(entry)(run_.add(entry.name), settings));
  services::subscribe(ground_, topics::goal_status, [this](const v1::GoalStatus& status) {
    GoalFate& fate = goals_[status.id()];
    if (fate.states.empty() || fate.states.back() != status.goal_state())
      fate.states.push_back(status.goal_state());
    fate.reason = status.reason();
  });
  services::subscribe(ground_, topics::mission_status,
                      [this](const v1::MissionStatus& status) { mission_ = status; });
  services::subscribe(ground_, topics::plan, [this](const v1::Plan& plan) { plans_.push_back(plan); });
  services::subscribe(ground_, topics::step_status,
                      [this](const v1::StepStatus& step) { steps_.push_back(step); });
  services::subscribe(ground_, topics::plan_request.request,
                      [this](const v1::PlanRequest& call) { calls_.push_back(call); });
  services::subscribe(ground_, topics::event, [this](const v1::Event& event) {
    events_.push_back(event.code() + " " + event.text());
  });
}

MissionInProcess::~MissionInProcess() {
  services_.clear();
  fs::remove_all(folder_);
}

std::string planetary_file(const std::string& name, const std::string& from, const std::string& to) {
  std::ifstream in(fs::path(ROCI_SOURCE_DIR "/missions/planetary") / name);
  std::string text(std::istreambuf_iterator<char>(in), {});
  if (from.empty()) return text;
  for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

void MissionInProcess::send(temporal::Time when, const v1::Goal& goal) {
  ground_.at(when, [this, goal] { goals_out_.write(goal); });
}

void MissionInProcess::run() { run_.run(); }

v1::Goal goal(const std::string& id, const std::string& kind,
              const std::vector<std::pair<std::string, std::string>>& arguments, v1::GoalClass importance,
              double utility) {
  v1::Goal out;
  out.issuer("ground");
  out.id(id);
  out.goal_kind(kind);
  for (const auto& [name, value] : arguments) {
    v1::Property argument;
    argument.name(name);
    argument.value(value);
    out.arguments().push_back(argument);
  }
  out.importance(importance);
  out.utility({utility});
  out.preferred_us(-1);
  return out;
}

}  // namespace roci::scenario
