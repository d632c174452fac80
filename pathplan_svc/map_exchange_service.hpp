// The map exchange is what a path planner hears of the terrain from its own robot and from the team, what it
// tells the team, and what it shows to observers.
#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pathplan_svc/map_file.hpp"
#include "pathplan_svc/shared_map.hpp"
#include "services/bounds/tally.hpp"
#include "services/owner/command_server.hpp"
#include "services/publisher.hpp"

namespace roci::pathplan {

/// Says who belongs to the robots of the mission.
struct Team {
  std::map<std::string, std::string> robots;  ///< by service
  std::vector<std::string> planners;          ///< services of a robot that tell maps
};

/// Keeps a robot's map beyond the loaded one up to date (topics `terrain_finding`, `map_patch`), and tells it when its
/// settings or the command `tell` say so; `merge` ends when a patch has been taken. A version that it tells counts each
/// change of what it knows, also one that changes no cell of its own map.
/// It lives as long as its node's loop runs.
class MapExchange final : private services::owner::Driver {
 public:
  /// What it needs of its service.
  struct Host {
    std::function<bool()> busy;     ///< whether the map can take no further change now
    std::function<void()> changed;  ///< discs() are others than before
    /// Calls back on the loop, when all changes so far are in the map, with its version then.
    std::function<void(std::function<void(std::uint64_t version)>)> settled;
  };

  MapExchange(services::Node&, const MapSettings&, const terrain::Grid&, const Team&, Host);

  std::vector<Disc> discs() const { return map_.discs(); }
  std::vector<FoundObstacle> obstacles() const { return map_.all(); }

 private:
  // A command that waits for a patch.
  struct Merge {
    services::owner::CommandKey key;
    std::string author;
    std::uint64_t version = 0;  // of the author's map that the patch must have at least
    services::Node::TimerId timer = 0;
  };

  void hear(const v1::TerrainFinding&);
  void give();
  void found();
  void update();
  void when_settled(std::function<void(std::uint64_t version)> then);
  void hear(const v1::MapPatch&);
  void take_over(const v1::MapPatch&, const MapPatch& in, const std::string& what);
  void show();
  void tell(const std::function<void(std::uint64_t version, std::size_t obstacles)>& told);
  void tell_as_commanded(const services::owner::CommandKey&);
  void merge(const services::owner::Request&);
  void end_merges();
  void give_up(const services::owner::CommandKey&);
  void say(const services::owner::CommandKey&, services::owner::Stage, const std::string& code = "",
           const std::string& reason = "");
  void refuse(const std::string& code, const std::string& what, const std::string& who,
              const std::string& why);
  void report(v1::Severity, const std::string& code, const std::string& text,
              const std::vector<std::pair<std::string, std::string>>& properties);

  void carry_out(const services::owner::Request&) override;
  void break_off(const services::owner::CommandKey&, const services::owner::CommandStatus& why) override;

  services::Node& node_;
  const MapSettings settings_;
  Host host_;
  const std::vector<std::string> planners_;
  SharedMap map_;
  std::vector<Merge> merges_;
  services::bounds::Tally refusals_;
  services::Publisher<v1::Event> events_;
  std::optional<services::Publisher<v1::MapPatch>> patches_;     // of who tells
  std::optional<services::Publisher<v1::KnownMap>> known_maps_;  // of a robot's
  std::map<std::string, temporal::Time> taken_at_;               // the newest patch, by author
  bool owing_ = false;               // something was found that the map has not been given yet
  bool giving_ = false;              // what was found before is on its way there
  std::uint64_t map_version_ = 0;    // as it was known last; 0: not yet
  std::uint64_t without_cells_ = 0;  // changes of what is known that left map_version_ as it was
  std::uint64_t told_version_ = 0;
  std::int64_t told_us_ = -1;
  std::optional<services::owner::CommandServer> commands_;
};

}  // namespace roci::pathplan
