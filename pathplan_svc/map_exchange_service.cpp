#include "pathplan_svc/map_exchange_service.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <utility>

#include "core/words/nearest_word.hpp"
#include "pathplan_svc/limits.hpp"
#include "services/node/make_event.hpp"

namespace roci::pathplan {
namespace {

namespace owner = services::owner;
namespace topics = services::topics;

constexpr double kLongestWait = 1e7;      // seconds
constexpr double kLargestVersion = 1e15;  // a double holds each version up to it

std::optional<double> number_in(const std::string& text) {
  double number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc{} || end != text.data() + text.size() || !std::isfinite(number)) return {};
  return number;
}

ObstacleKind kind_of(v1::ObstacleKind kind) {
  return kind == v1::OBSTACLE_SOIL ? ObstacleKind::soil : ObstacleKind::rock;
}

FoundObstacle obstacle_of(const v1::TerrainFinding& in) {
  return {in.robot(),
          in.id(),
          kind_of(in.obstacle_kind()),
          {{in.x_m(), in.y_m()}, in.radius_m()},
          in.cleared(),
          temporal::Time{in.found_us()}};
}

FoundObstacle obstacle_of(const v1::MapObstacle& in) {
  return {in.found_by(),
          in.id(),
          kind_of(in.obstacle_kind()),
          {{in.x_m(), in.y_m()}, in.radius_m()},
          in.cleared(),
          temporal::Time{in.found_us()}};
}

v1::MapObstacle to_wire(const FoundObstacle& one) {
  v1::MapObstacle out;
  out.found_by(one.finder);
  out.id(one.id);
  out.obstacle_kind(one.kind == ObstacleKind::soil ? v1::OBSTACLE_SOIL : v1::OBSTACLE_ROCK);
  out.x_m(one.disc.centre.x);
  out.y_m(one.disc.centre.y);
  out.radius_m(one.disc.radius);
  out.cleared(one.cleared);
  out.found_us(one.found.count());
  return out;
}

}  // namespace

MapExchange::MapExchange(services::Node& node, const MapSettings& settings, const terrain::Grid& grid,
                         const Team& team, Host host)
    : node_(node),
      settings_(settings),
      host_(std::move(host)),
      planners_(team.planners),
      map_(node.options().robot, grid, team.robots),
      events_(services::advertise(node, topics::event)) {
  services::subscribe(node, topics::terrain_finding, [this](const v1::TerrainFinding& one) { hear(one); });
  services::subscribe(node, topics::map_patch, [this](const v1::MapPatch& patch) { hear(patch); });
  if (!node.options().robot.empty()) {
    known_maps_ = services::advertise(node, topics::known_map);
    node.after(temporal::Duration{0}, [this] { show(); });
  }
  if (settings_.sharing == MapSharing::never) return;
  patches_ = services::advertise(node, topics::map_patch);
  commands_.emplace(node, static_cast<owner::Driver&>(*this));
}

void MapExchange::hear(const v1::TerrainFinding& finding) {
  const std::string& robot = node_.options().robot;
  if (!robot.empty() && finding.robot() != robot) return;  // the world speaks for all robots
  const std::string id = finding.id().substr(0, SharedMap::kNameBytes);
  const Intake intake = map_.find(obstacle_of(finding));
  if (!intake.refusal.empty())
    return refuse("map.finding_refused", "finding " + id, finding.robot(), intake.refusal);
  if (!intake.changed) return;
  owing_ = true;
  give();
}

// What is found while the map takes what was found before goes there in one, so that a burst of findings fills no
// queue: nobody sends them again.
void MapExchange::give() {
  if (giving_ || !owing_) return;
  giving_ = true;
  found();
  host_.settled([this](std::uint64_t) {
    giving_ = false;
    give();
  });
}

void MapExchange::found() {
  update();
  show();
  if (settings_.sharing == MapSharing::at_once) tell({});
}

// What changes no cell of this map may change some of another robot's: it has a version of its own, too.
void MapExchange::update() {
  owing_ = false;
  host_.changed();
  host_.settled([this](std::uint64_t version) {
    if (std::exchange(map_version_, version) == version) ++without_cells_;
  });
}

void MapExchange::when_settled(std::function<void(std::uint64_t version)> then) {
  if (owing_) found();
  host_.settled([this, then = std::move(then)](std::uint64_t version) {
    map_version_ = version;
    then(version + without_cells_);
  });
}

void MapExchange::hear(const v1::MapPatch& patch) {
  if (patch.header().sender() == node_.options().name) return;
  MapPatch in{
      patch.author(), patch.header().robot(), {patch.header().incarnation(), patch.header().seq()}, {}};
  in.map_version = patch.map_version();
  in.told = std::min(temporal::Time{patch.header().stamp_us()}, node_.now());
  const std::string who = in.author.substr(0, SharedMap::kNameBytes);
  const std::string sender = patch.header().sender().substr(0, SharedMap::kNameBytes);
  const bool genuine = patch.header().sender() == in.author;
  const std::string what = "patch " + std::to_string(in.number.second) + " of " + who;
  const auto refused = [&](const std::string& why) {
    refuse("map.patch_refused", what, genuine ? who : sender + " as " + who, why);
  };
  if (!genuine) return refused("it comes from '" + sender + "'");
  if (patch.obstacles().size() > SharedMap::kMost)
    return refused("it holds more than " + std::to_string(SharedMap::kMost) + " obstacles");
  if (host_.busy()) return refused("it comes while the map is being built; send it again");
  for (const v1::MapObstacle& one : patch.obstacles()) in.obstacles.push_back(obstacle_of(one));
  const Intake intake = map_.take(in);
  if (!intake.refusal.empty()) return refused(intake.refusal);
  taken_at_[in.author] = node_.now();
  if (intake.changed) take_over(patch, in, what);
  show();
  end_merges();
}

void MapExchange::take_over(const v1::MapPatch& patch, const MapPatch& in, const std::string& what) {
  report(
      v1::SEVERITY_INFO, "map.patch_taken",
      what + " brings the map of " + in.robot + " up to its version " + std::to_string(patch.map_version()),
      {{"author", in.author.substr(0, SharedMap::kNameBytes)},
       {"map_version", std::to_string(patch.map_version())}});
  owing_ ? found() : update();  // in either case with all that is known
}

// What is told is what is known now; the version is that of the map with all of it.
void MapExchange::tell(const std::function<void(std::uint64_t, std::size_t)>& told) {
  v1::MapPatch patch;
  patch.author(node_.options().name);
  for (const FoundObstacle& one : map_.all()) patch.obstacles().push_back(to_wire(one));
  when_settled([this, patch, told](std::uint64_t version) mutable {
    const std::size_t count = patch.obstacles().size();
    patch.map_version(version);
    patches_->write(std::move(patch));
    told_version_ = version;
    told_us_ = node_.now().count();
    report(v1::SEVERITY_INFO, "map.told",
           "the team is told of " + std::to_string(count) + " obstacles of the map's version " +
               std::to_string(version),
           {{"map_version", std::to_string(version)}, {"obstacles", std::to_string(count)}});
    if (told) told(version, count);
    show();
  });
}

// For who watches; the version is that of the map with all of it.
void MapExchange::show() {
  if (!known_maps_) return;
  v1::KnownMap known;
  known.planner(node_.options().name);
  for (const FoundObstacle& one : map_.all()) known.obstacles().push_back(to_wire(one));
  when_settled([this, known](std::uint64_t version) mutable {
    known.map_version(version);
    known.told_version(told_version_);
    known.told_us(told_us_);
    for (const auto& [author, at] : taken_at_) {
      const TakenPatch* patch = map_.newest(author);
      if (patch == nullptr) continue;
      v1::TakenPatch& taken = known.taken().emplace_back();
      taken.author(author);
      taken.map_version(patch->map_version);
      taken.taken_us(at.count());
    }
    known_maps_->write(std::move(known));
  });
}

void MapExchange::carry_out(const owner::Request& request) {
  const bool mine = request.subsystem == settings_.subsystem;
  if (mine && request.command == "merge") return merge(request);
  if (mine && request.command == "tell") return tell_as_commanded(request.key);
  say(request.key, owner::Stage::rejected, "unknown-command",
      "the path planner has '" + settings_.subsystem + "' with the commands tell and merge, and no '" +
          request.subsystem + "' with '" + request.command + "'");
}

void MapExchange::tell_as_commanded(const owner::CommandKey& key) {
  say(key, owner::Stage::accepted);
  tell([this, key](std::uint64_t version, std::size_t obstacles) {
    owner::CommandStatus status{owner::Stage::completed, "", "", {}};
    status.results.values = {{"map_version", static_cast<double>(version)},
                             {"obstacles", static_cast<double>(obstacles)}};
    commands_->say(key, std::move(status));
  });
}

void MapExchange::merge(const owner::Request& request) {
  const auto rejected = [&](const std::string& code, const std::string& why) {
    say(request.key, owner::Stage::rejected, code, why);
  };
  const auto text_of = [&](const std::string& name, const std::string& otherwise) {
    const auto found = request.arguments.find(name);
    return found == request.arguments.end() ? otherwise : found->second;
  };
  const std::string author = text_of("author", "");
  if (author == node_.options().name || std::ranges::find(planners_, author) == planners_.end())
    return rejected("unknown-author", "'" + author.substr(0, SharedMap::kNameBytes) +
                                          "' is no other path planner of the team; name one as author" +
                                          words::did_you_mean(author, planners_));
  const auto version = number_in(text_of("version", "0")), within = number_in(text_of("within_s", "600"));
  if (!version || *version < 0 || *version != std::floor(*version) || *version > kLargestVersion)
    return rejected("bad-arguments", "the version is that of the author's map, as its command tell told it");
  if (!within || *within <= 0 || *within > kLongestWait)
    return rejected("bad-arguments", "within_s is a positive time in seconds");
  if (merges_.size() >= kMerges)
    return rejected("busy", std::to_string(kMerges) + " merges wait already; cancel some");
  say(request.key, owner::Stage::accepted);
  const temporal::Time until = node_.now() + temporal::seconds(*within);
  merges_.push_back({request.key, author, static_cast<std::uint64_t>(*version),
                     node_.at(std::min(until, request.latest_end.value_or(until)),
                              [this, key = request.key] { give_up(key); })});
  end_merges();
}

// Those whose patch is there are completed when it is in the map, too.
void MapExchange::end_merges() {
  std::erase_if(merges_, [this](const Merge& one) {
    const TakenPatch* patch = map_.newest(one.author);
    if (patch == nullptr || patch->map_version < one.version) return false;
    node_.cancel(one.timer);
    when_settled([this, key = one.key, patch = *patch](std::uint64_t version) {
      owner::CommandStatus status{owner::Stage::completed, "", "", {}};
      status.results.values = {{"map_version", static_cast<double>(version)},
                               {"obstacles", static_cast<double>(map_.all().size())},
                               {"author_version", static_cast<double>(patch.map_version)},
                               {"told_s", temporal::to_seconds(patch.told)},
                               {"age_s", temporal::to_seconds(node_.now() - patch.told)}};
      commands_->say(key, std::move(status));
    });
    return true;
  });
}

void MapExchange::give_up(const owner::CommandKey& key) {
  const auto merge = std::ranges::find(merges_, key, &Merge::key);
  if (merge == merges_.end()) return;
  const TakenPatch* patch = map_.newest(merge->author);
  const std::string why =
      "no patch of " + merge->author + " with version " + std::to_string(merge->version) + " came; " +
      (patch == nullptr ? std::string("it has told none")
                        : "the newest that was taken has version " + std::to_string(patch->map_version));
  merges_.erase(merge);
  say(key, owner::Stage::failed, "patch-missing", why);
}

void MapExchange::break_off(const owner::CommandKey& key, const owner::CommandStatus& why) {
  const auto merge = std::ranges::find(merges_, key, &Merge::key);
  if (merge == merges_.end()) {
    commands_->refuse_cancel(key, "a map is told at once, and a patch that is there is merged at once");
    return;
  }
  node_.cancel(merge->timer);
  merges_.erase(merge);
  commands_->say(key, why);
}

void MapExchange::say(const owner::CommandKey& key, owner::Stage stage, const std::string& code,
                      const std::string& reason) {
  commands_->say(key, {stage, code, reason, {}});
}

// Told the first time, the tenth, the hundredth and so on, by who it came from.
void MapExchange::refuse(const std::string& code, const std::string& what, const std::string& who,
                         const std::string& why) {
  const std::uint64_t count = refusals_.note(code + " " + who);
  if (count == 0) return;
  report(v1::SEVERITY_WARNING, code,
         what + ": " + why + (count > 1 ? " (" + std::to_string(count) + " refused so far)" : ""),
         {{"from", who}});
}

void MapExchange::report(v1::Severity severity, const std::string& code, const std::string& text,
                         const std::vector<std::pair<std::string, std::string>>& properties) {
  events_.write(services::node::make_event(severity, code, text, properties));
}

}  // namespace roci::pathplan
