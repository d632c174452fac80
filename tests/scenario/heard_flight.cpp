#include "tests/scenario/heard_flight.hpp"

#include <fstream>

#include "core/mission/service_list.hpp"
#include "rehearsal/flight.hpp"
#include "services/publisher.hpp"
#include "services/service.hpp"
#include "tests/scenario/flight.hpp"

namespace roci::scenario {
namespace {

namespace fs = std::filesystem;
namespace topics = services::topics;

constexpr char kListener[] = "flight_listener";

HeardFlight* now_heard = nullptr;  // a service is made by a plain function

class Listener final : public services::Service {
 public:
  Listener(services::Node& node, HeardFlight& heard) : order_(heard.order) {
    keep(node, topics::observation, heard.observations);
    keep(node, topics::step_status, heard.steps);
    keep(node, topics::command, heard.commands);
    keep(node, topics::command_ack, heard.answers);
    keep(node, topics::data_product, heard.products);
    keep(node, topics::plan_delta, heard.plans);
    keep(node, topics::mission_outlook, heard.outlooks);
    keep(node, topics::downlink_schedule, heard.schedules);
    keep(node, topics::event, heard.events);
    keep(node, topics::path_request.request, heard.paths);
    keep(node, topics::executed_plan, heard.executed);
    keep(node, topics::mission_status, heard.statuses);
  }

 private:
  template <class Topic, class Sample>
  void keep(services::Node& node, const Topic& topic, std::vector<Sample>& in) {
    services::subscribe(node, topic, [this, &in, name = std::string(topic.name)](const Sample& sample) {
      order_.push_back({name, in.size()});
      in.push_back(sample);
    });
  }

  std::vector<HeardSample>& order_;
};

std::unique_ptr<services::Service> make_listener(services::Node& node, const services::RunSettings&) {
  return std::make_unique<Listener>(node, *now_heard);
}

// A path names a program of the mission's own; rehearsal asks for its file's name.
void add_listener(const fs::path& mission) {
  const fs::path program = mission / "bin" / kListener;
  if (fs::exists(program)) return;
  fs::create_directories(program.parent_path());
  std::ofstream{program};
  edit(mission / "mission.yaml", "services:\n",
       std::string("services:\n  - {name: listener, program: bin/") + kListener + "}\n");
}

}  // namespace

HeardFlight hear_flight(const fs::path& mission, const std::string& scenario, const fs::path& run_folder,
                        std::uint64_t seed) {
  static int domain = 0;
  add_listener(mission);
  fs::create_directories(run_folder);
  rehearsal::FlightOptions options;
  options.run.mission = mission;
  options.run.scenario = scenario;
  options.run.run_folder = run_folder;
  options.run.seed = seed;
  options.domain = ++domain;
  options.programs = {{kListener, make_listener}};
  HeardFlight out;
  now_heard = &out;
  rehearsal::fly(options);
  std::ifstream effects(run_folder / "effects.jsonl");
  for (std::string line; std::getline(effects, line);) out.deeds.push_back(nlohmann::json::parse(line));
  out.summary = nlohmann::json::parse(std::ifstream(run_folder / services::kSummaryFile), nullptr, false);
  return out;
}

}  // namespace roci::scenario
