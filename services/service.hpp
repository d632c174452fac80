// A service is built on a node and lives until the node's loop ends. Each X_svc offers `make_service` in
// x_service.hpp; its main() is process::service_main(argc, argv, "x_svc", make_service); a rehearsal runs the
// same functions in one process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>

#include "services/node.hpp"

namespace roci::services {

/// Owns what the handlers of a service use, and lives until the node's loop has ended.
class Service {
 public:
  virtual ~Service() = default;
};

/// Holds what a run hands to each service. Services read the files themselves (core/mission/entry.hpp).
struct RunSettings {
  std::filesystem::path mission;     ///< folder with mission.yaml
  std::string scenario = "nominal";  ///< stands in scenarios/<name>.yaml of the mission folder
  std::uint64_t seed = 1;
  std::filesystem::path run_folder{};  ///< holds journal, summary.json and logs of this run
  /// Names the process, "first" or "second", of two that stand in for each other; empty when it is alone.
  std::string pair{};
  std::filesystem::path settings{};  ///< mission file that this service reads; empty: mission.yaml
  bool secure = false;               ///< each service may do only what its certificate permits

  std::filesystem::path mission_file() const {
    return settings.empty() ? mission / "mission.yaml" : settings;
  }
};

using MakeService = std::unique_ptr<Service>(Node&, const RunSettings&);

/// Names the file of the run folder in which sim_svc tells how the events compare with the scenario's list,
/// if it has one.
inline constexpr char kExpectedFile[] = "expected.json";

/// Names the file of the run folder with the outcome of a run. Its `format`, the version of its schema
/// (docs/formats.md), rises when a key changes its meaning or goes; a summary without it is of version 1.
inline constexpr char kSummaryFile[] = "summary.json";
inline constexpr int kSummaryFormat = 1;

}  // namespace roci::services
