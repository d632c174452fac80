#include "dedicated_svc/dedicated_service.hpp"

#include <string>
#include <utility>

#include "core/mission/mission_file.hpp"
#include "core/mission/service_list.hpp"
#include "core/words/nearest_word.hpp"
#include "dedicated_svc/calls_service.hpp"
#include "dedicated_svc/methods/methods_file.hpp"
#include "services/node/make_event.hpp"
#include "services/owner/command_server.hpp"
#include "services/publisher.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::dedicated {
namespace {

namespace owner = services::owner;
namespace topics = services::topics;
using method_run::MethodRun;
using owner::Stage;

/// Objects of the mission that are places: those with numbers x and y.
Spots read_spots(const mission::Entry& root) {
  Spots spots;
  const auto objects = root.find("objects");
  if (!objects) return spots;
  for (const mission::Entry& object : objects->items()) {
    const auto properties = object.find("properties");
    if (!properties) continue;
    const auto x = properties->find("x"), y = properties->find("y");
    if (!x || !y || x->is_mapping() || y->is_mapping()) continue;
    spots[object.at("name").text()] = {x->number(), y->number(), properties->number_or("heading", 0)};
  }
  return spots;
}

// Whoever shows a timeline is the one owner of its subsystem. A file of another one that cannot be read is told by that one.
void expect_one_owner(const mission::Entry& section, const std::string& own_name,
                      const std::filesystem::path& mission_folder) {
  const mission::Entry timeline = section.at("timeline");
  const mission::ServiceList list = mission::load_service_list_if_any(mission_folder);
  for (const mission::ServiceEntry* other : list.of_program("dedicated_svc")) {
    if (other->name == own_name) continue;
    std::string place;
    try {
      const auto shown = mission::load_mission_file(other->settings).at("dedicated").at("timeline");
      if (shown.text() == timeline.text()) place = shown.place();
    } catch (const mission::FileError&) {
      continue;
    }
    if (!place.empty())
      timeline.fail(
          "the timeline '" + timeline.text() + "' of " + own_name + " is that of " + other->name + ", too (" +
          place +
          "): a subsystem has one owner; give each a timeline of its own, or drop one from 'services'");
  }
}

class DedicatedService final : public services::Service, private owner::Driver {
 public:
  DedicatedService(services::Node& node, methods::Methods methods, Spots spots,
                   const std::filesystem::path& run_folder)
      : node_(node),
        methods_(std::move(methods)),
        record_(run_folder.empty() ? run_folder : run_folder / (node.options().name + ".calls")),
        states_(services::advertise(node, topics::observation)),
        events_(services::advertise(node, topics::event)),
        calls_(node, record_, std::move(spots)),
        commands_(node, *this) {
    if (!run_folder.empty()) commands_.keep_in(run_folder / (node.options().name + ".ledger"));
    node.after(temporal::Duration(0), [this] {
      show(temporal::state(methods_.rest.name, methods_.rest.arguments));
      if (record_.damaged())
        tell("calls.damaged", "what an earlier process commanded is not known: its record cannot be read");
      if (record_.open())
        tell("calls.settling",
             "asks " + record_.open()->owner + " what became of " + record_.open()->key.activity);
      calls_.settle([this] { settled(); });
    });
  }

 private:
  // One command from above that is being carried out.
  struct UnderWay {
    owner::Request request;
    MethodRun run;
    std::optional<owner::Word> broken_off{};  // why it is to end early
  };

  void carry_out(const owner::Request& request) override {
    const auto method = methods_.methods.find(request.command);
    if (method == methods_.methods.end()) return reject(request, "unknown-command", unknown(request.command));
    for (const std::string& name : method->second.arguments)
      if (!request.arguments.contains(name))
        return reject(request, "wrong-arguments", request.command + " needs the argument '" + name + "'");
    if (under_way_ || waiting_)
      return reject(request, "busy",
                    "it carries out " + (under_way_ ? under_way_->request : *waiting_).command);
    commands_.say(request.key, {Stage::accepted});
    waiting_ = request;
    if (settled_) begin();
  }

  void begin() {
    const owner::Request request = *std::exchange(waiting_, std::nullopt);
    const methods::Method& method = methods_.methods.at(request.command);
    under_way_.emplace(UnderWay{request, MethodRun(method, request.arguments)});
    show(under_way_->run.during());
    go_on(under_way_->run.begin());
  }

  void settled() {
    settled_ = true;
    if (waiting_) begin();
  }

  void break_off(const owner::CommandKey& key, const owner::Word& why) override {
    if (waiting_ && waiting_->key == key) {
      waiting_.reset();
      commands_.say(key, why);
    } else if (under_way_ && under_way_->request.key == key && !under_way_->broken_off) {
      under_way_->broken_off = why;
      calls_.break_off();
    }
  }

  void go_on(const method_run::Step& step) {
    if (step.end) return finish(*step.end);
    if (!step.repairing.empty() && !commands_.repair(under_way_->request.key, step.repairing))
      return finish(under_way_->run.forbid_repair());
    calls_.begin(*step.ask, under_way_->request, [this](const method_run::Answer& answer) {
      if (under_way_->broken_off) return finish_early(answer);
      go_on(under_way_->run.take(answer, calls_.observed()));
    });
  }

  // The word that says why stands, whatever the call came to in the meantime.
  void finish_early(const method_run::Answer& answer) {
    owner::Word word = *under_way_->broken_off;
    word.results.values = answer.values;
    end(under_way_->run.failed({.error = word.code.empty() ? "stopped" : word.code}, methods_.rest),
        std::move(word));
  }

  void finish(const method_run::End& result) {
    owner::Word word{Stage::completed, "done", result.reason, {}};
    word.results.energy_j = result.energy_j;
    word.results.values = result.values;
    for (const auto& [timeline, value] : under_way_->run.told(result)) show(timeline, value);
    if (result.error.empty()) return end(under_way_->run.then(methods_.rest), std::move(word));
    word.stage = Stage::failed;
    word.code = result.error;
    end(under_way_->run.failed(result, methods_.rest), std::move(word));
  }

  void end(const temporal::Value& state, owner::Word word) {
    const owner::CommandKey key = under_way_->request.key;
    under_way_.reset();
    show(state);
    commands_.say(key, std::move(word));
  }

  void reject(const owner::Request& request, const std::string& code, const std::string& reason) {
    commands_.say(request.key, {Stage::rejected, code, reason, {}});
  }

  std::string unknown(const std::string& command) const {
    std::vector<std::string> known;
    for (const auto& [name, method] : methods_.methods) known.push_back(name);
    return "it has no method '" + command + "'" + words::did_you_mean(command, known);
  }

  void show(const temporal::Value& state) { show(methods_.timeline, state); }
  void show(const std::string& timeline, const temporal::Value& state) {
    v1::Observation seen;
    seen.timeline(timeline);
    seen.observed(services::wire::to_wire(state));
    seen.sampled_us(node_.now().count());
    states_.write(seen);
  }

  void tell(const std::string& code, const std::string& text) {
    events_.write(services::node::make_event(v1::SEVERITY_WARNING, code, text));
  }

  services::Node& node_;
  methods::Methods methods_;
  CallRecord record_;
  services::Publisher<v1::Observation> states_;
  services::Publisher<v1::Event> events_;
  Calls calls_;
  owner::CommandServer commands_;
  std::optional<UnderWay> under_way_;
  std::optional<owner::Request>
      waiting_;  // until it is known what became of what an earlier process commanded
  bool settled_ = false;
};

}  // namespace

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings) {
  const mission::Entry root = mission::load_mission_file(settings.mission_file());
  expect_one_owner(root.at("dedicated"), node.options().name, settings.mission);
  return std::make_unique<DedicatedService>(node, methods::read_methods(root.at("dedicated")),
                                            read_spots(root), settings.run_folder);
}

}  // namespace roci::dedicated
