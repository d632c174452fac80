// A service: built on a node, alive until the node's loop ends. Each X_svc offers `make_service` in
// x_service.hpp; its main() is process::service_main(argc, argv, "x_svc", make_service); rehearsal runs the
// same functions in one process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "services/node.hpp"

namespace roci::services {

class Service {
 public:
  virtual ~Service() = default;
};

// What a run hands to each service. Files are read by the services themselves (core/mission/entry.hpp).
struct RunSettings {
  std::filesystem::path mission;     // folder with mission.yaml
  std::string scenario = "nominal";  // scenarios/<name>.yaml in the mission folder
  std::uint64_t seed = 1;
  std::filesystem::path run_folder;  // journal, summary.json, logs of this run
  std::string pair{};  // "first", "second": of two processes that stand in for each other; empty: it is alone
  std::filesystem::path settings{};  // the mission file that this service reads; empty: mission.yaml of the folder

  std::filesystem::path mission_file() const { return settings.empty() ? mission / "mission.yaml" : settings; }
};

using MakeService = std::unique_ptr<Service>(Node&, const RunSettings&);

// In the run folder: what sim_svc found when it compared the events with the scenario's list; optional.
inline constexpr char kExpectedFile[] = "expected.json";

/// In the run folder: the outcome of a run, with `format`, the version of its schema (docs/formats.md). It
/// rises when a key changes its meaning or goes; a summary without it is of version 1.
inline constexpr char kSummaryFile[] = "summary.json";
inline constexpr int kSummaryFormat = 1;

}  // namespace roci::services
