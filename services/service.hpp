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

/// A run hands this to each service. Files are read by the services themselves (core/mission/entry.hpp).
struct RunSettings {
  std::filesystem::path mission;     ///< The folder with mission.yaml.
  std::string scenario = "nominal";  ///< It stands in scenarios/<name>.yaml of the mission folder.
  std::uint64_t seed = 1;
  std::filesystem::path run_folder{};  ///< It holds journal, summary.json and logs of this run.
  /// "first" or "second" of two processes that stand in for each other; empty when the process is alone.
  std::string pair{};
  std::filesystem::path settings{};  ///< The mission file that this service reads; empty: mission.yaml.
  bool secure = false;               ///< Each service may do only what its certificate permits.

  std::filesystem::path mission_file() const {
    return settings.empty() ? mission / "mission.yaml" : settings;
  }
};

using MakeService = std::unique_ptr<Service>(Node&, const RunSettings&);

/// In this file of the run folder sim_svc tells how the events compare with the list of the scenario, if it
/// has one.
inline constexpr char kExpectedFile[] = "expected.json";

/// In the run folder: the outcome of a run, with `format`, the version of its schema (docs/formats.md). It
/// rises when a key changes its meaning or goes; a summary without it is of version 1.
inline constexpr char kSummaryFile[] = "summary.json";
inline constexpr int kSummaryFormat = 1;

}  // namespace roci::services
