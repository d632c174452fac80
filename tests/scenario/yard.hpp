// The yard of missions/faster, flown by commands alone: the world and both path planners as services, and a driver that
// commands one after the other.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "core/terrain/grid.hpp"
#include "services/process/domain_claim.hpp"
#include "services/publisher.hpp"
#include "services/rpc.hpp"
#include "services/service.hpp"
#include "services/topics/topics.hpp"
#include "tests/unit/services/sim_run.hpp"

namespace roci::scenario {

struct YardCommand {
  std::string owner;  // service
  std::string robot;
  std::string subsystem;
  std::string command;
  std::map<std::string, std::string> arguments;
};

/// Asks the path planner of the robot for the way from one place to another; its word has the way, or the code no-path.
YardCommand path(const std::string& robot, terrain::Point from, terrain::Point to);
YardCommand drive(const std::string& robot, double x, double y);
/// The robot drives over these points and asks no planner.
YardCommand drive_over(const std::string& robot, const std::vector<terrain::Point>& way);
YardCommand turn(const std::string& robot, double x, double y);
YardCommand localise();
/// The path planner of the robot tells its map.
YardCommand tell(const std::string& robot);
/// The path planner of the robot waits for at least this version of the other's map, so many seconds at most.
YardCommand merge(const std::string& robot, const std::string& author, double version, double within_s = 60);

struct YardWord {
  v1::CommandStage stage = v1::STAGE_UNKNOWN;
  std::string code;
  std::string reason;
  std::map<std::string, double> results;
  std::vector<terrain::Point> way;  ///< of a path
};

class Yard {
 public:
  /// Chooses the next command by the words on those before; nothing: the flight is over.
  using Script = std::function<std::optional<YardCommand>(const std::vector<YardWord>&)>;

  /// `vendors` are those of sim_svc, primary.path, scout.path and the driver, one after the other.
  Yard(const std::string& scenario, std::vector<std::string> vendors, Script script, std::uint64_t seed = 1);
  ~Yard();

  /// Hands all that both rovers tell to a view, which takes it as a console's does and must outlive the run.
  template <class View>
  void watch(View& view) {
    namespace topics = services::topics;
    const auto take = [&view](const auto& sample) { view.take(sample); };
    services::subscribe(*driver_, topics::observation, take);
    services::subscribe(*driver_, topics::known_map, take);
    services::subscribe(*driver_, topics::command, take);
    services::subscribe(*driver_, topics::command_ack, take);
  }

  void run();

  const std::vector<YardWord>& words() const { return words_; }
  /// "time sender code text" of each event, in the order in which they were heard.
  const std::vector<std::string>& events() const { return events_; }
  /// Times and words of all acknowledgements and events of the flight.
  const std::vector<std::string>& trace() const { return trace_; }

 private:
  void next();
  void ask(const YardCommand&);
  void hear(const v1::CommandAck&);
  void end(YardWord);

  std::filesystem::path folder_;
  std::vector<std::string> vendors_;
  Script script_;
  services::process::DomainClaim domain_;
  services::SimRun run_;
  std::vector<std::unique_ptr<services::Service>> services_;
  services::Node* driver_ = nullptr;
  services::Publisher<v1::Command> commands_;
  std::optional<services::Client<v1::PathRequest, v1::PathReply>> paths_;
  services::Publisher<v1::MissionStatus> status_;
  std::vector<YardWord> words_;
  std::vector<std::string> events_;
  std::vector<std::string> trace_;
  std::string running_;
};

}  // namespace roci::scenario
