// One flight with all services in this process, and all that they tell each other of it: what no run folder keeps.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "roci_idl/command.h"
#include "roci_idl/executed.h"
#include "roci_idl/health.h"
#include "roci_idl/motion.h"
#include "roci_idl/outlook.h"
#include "roci_idl/plan.h"
#include "roci_idl/planner.h"

namespace roci::scenario {

/// One sample of a HeardFlight.
struct HeardSample {
  std::string topic;
  std::size_t index = 0;  ///< in the topic's list
};

/// Holds samples, each list in the order in which they were heard; `header().stamp_us()` is mission time.
struct HeardFlight {
  std::vector<v1::Observation> observations;
  std::vector<v1::StepStatus> steps;
  std::vector<v1::Command> commands;
  std::vector<v1::CommandAck> answers;  ///< of owners to commands
  std::vector<v1::DataProduct> products;
  std::vector<v1::PlanDelta> plans;
  std::vector<v1::MissionOutlook> outlooks;
  std::vector<v1::DownlinkSchedule> schedules;
  std::vector<v1::Event> events;
  std::vector<v1::PathRequest> paths;  ///< that path planners were asked for
  std::vector<v1::ExecutedPlan> executed;
  std::vector<v1::MissionStatus> statuses;
  std::vector<HeardSample> order;     ///< of all samples in the lists above
  std::vector<nlohmann::json> deeds;  ///< what the world records of what was really done (effects.jsonl)
  nlohmann::json summary;             ///< of the only executive
};

/// Flies the mission to its end, over inproc, with one seed; its trace is that of processes (rehearsal/README.md). A
/// listener is added to the services of mission.yaml, so the folder is one of the test's own.
HeardFlight hear_flight(const std::filesystem::path& mission, const std::string& scenario,
                        const std::filesystem::path& run_folder, std::uint64_t seed = 1);

}  // namespace roci::scenario
