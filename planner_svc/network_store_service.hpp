// The network store keeps in the run folder what the ground has changed of the engine's model, so that it
// outlives the planner's process.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"

namespace roci::planner {

/// Says how far an order of the ground has come, in the order of NetworkStage in idl/network.idl.
enum class NetworkStage { received, refused, accepted, in_force };

/// Holds one order and where it stands.
struct NetworkRecord {
  std::string issuer;
  std::string id;
  NetworkStage stage = NetworkStage::received;
  std::string parameter;  ///< that is set; empty: the model is replaced
  double value = 0;
  engine::ModelName model;          ///< in force when this was said
  std::uint32_t after_version = 0;  ///< with accepted: a later version of the plan is made with it
  std::uint32_t plan_version = 0;  ///< with in_force: the first of them that was executed; 0: none was needed
  std::vector<std::string> reasons;
  friend bool operator==(const NetworkRecord&, const NetworkRecord&) = default;
};

/// Holds the ground's orders, and the newest model that they brought.
struct KeptNetworks {
  std::vector<NetworkRecord> orders;
  /// Names the file that holds the newest model of the ground; empty: the mission's is in force.
  std::string model;
  std::uint32_t checksum = 0;  ///< of the file
  friend bool operator==(const KeptNetworks&, const KeptNetworks&) = default;
};

/// Keeps orders.json and the newest model in a folder. A model is written under a name of its own before the list that
/// names it replaces the one before, so that both are whole whenever the process ends.
class NetworkStore {
 public:
  /// Empty: nothing is kept, and keep() throws.
  explicit NetworkStore(std::filesystem::path folder) : folder_(std::move(folder)) {}

  /// Returns nothing where nothing was kept. Throws std::runtime_error that names the damaged file.
  std::optional<KeptNetworks> load() const;
  /// Puts a list in the place of the one before. With `model`, the bytes of the new one, names its file in `kept`, too.
  /// When it returns all is on the disk. Throws std::runtime_error; then what was kept before is.
  void keep(KeptNetworks& kept, const std::string* model = nullptr) const;
  /// Forgets what another run left here.
  void clear() const;
  bool keeps() const { return !folder_.empty(); }
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }

 private:
  std::filesystem::path folder_;
};

}  // namespace roci::planner
