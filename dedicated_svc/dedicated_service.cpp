#include "dedicated_svc/dedicated_service.hpp"

#include <functional>
#include <string>
#include <system_error>
#include <utility>

#include "core/mission/mission_file.hpp"
#include "core/words/nearest_word.hpp"
#include "dedicated_svc/calls_service.hpp"
#include "dedicated_svc/methods/methods_file.hpp"
#include "dedicated_svc/methods/sole_owner.hpp"
#include "services/node/make_event.hpp"
#include "services/owner/command_server.hpp"
#include "services/publisher.hpp"
#include "services/wire/plan_wire.hpp"

namespace roci::dedicated {
namespace {

namespace owner = services::owner;
namespace topics = services::topics;
using method_run::MethodRun;
using method_run::Step;
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

// After a death whoever commanded what was under way must ask for it within this time, else it has failed; from then on
// what was observed is heard for so long before it goes on.
constexpr temporal::Duration kAskedWithin = std::chrono::seconds(10);
constexpr temporal::Duration kHear = std::chrono::seconds(1);

class DedicatedService final : public services::Service, private owner::Driver {
 public:
  DedicatedService(services::Node& node, methods::Methods methods, Spots spots,
                   const std::filesystem::path& run_folder, std::function<void()> around_write)
      : node_(node),
        methods_(std::move(methods)),
        record_(run_folder.empty() ? run_folder : run_folder / (node.options().name + ".calls"),
                std::move(around_write)),
        states_(services::advertise(node, topics::observation)),
        events_(services::advertise(node, topics::event)),
        calls_(node, record_, std::move(spots)),
        commands_(node, *this) {
    if (!run_folder.empty()) take_up(run_folder / (node.options().name + ".ledger"));
    node.after(temporal::Duration(0), [this] { begin_life(); });
  }

 private:
  // One command from above that is being carried out.
  struct UnderWay {
    owner::Request request;
    MethodRun run;
    std::optional<owner::CommandStatus> broken_off{};  // why it is to end early
  };
  // One of an earlier process, until whoever commanded it asks for it.
  struct Kept {
    Step step;  // to which it had come
    temporal::Time call_begun{};
    services::Node::TimerId timer = 0;
    bool asked = false;
  };

  // Finds out from ledger and record what the process before this one was doing,
  // and whether this one is able to go on with it.
  void take_up(const std::filesystem::path& ledger) {
    const std::optional<RunRecord> before = record_.run();
    std::optional<Step> step;
    if (before && methods_.methods.contains(before->request.command)) {
      const methods::Method& method = methods_.methods.at(before->request.command);
      under_way_.emplace(
          UnderWay{before->request, MethodRun(method, before->request.arguments), before->broken_off});
      step = under_way_->run.begin_after(before->taken);
    }
    const bool able = step && fits(*step, before->request);
    if (commands_.keep_in(
            ledger, able ? std::optional(owner::Resumed{before->request, before->begun}) : std::nullopt)) {
      kept_ = Kept{*step, before->call_begun};
      return;
    }
    if (before) ended_before_ = before->request.key;
    if (before && under_way_) keep([&] { record_.end_run(state_at_death(able ? &*step : nullptr)); });
    under_way_.reset();
  }

  // Whether the command that is open is that of the call to which the run has come.
  bool fits(const Step& step, const owner::Request& request) const {
    if (!record_.open()) return step.ask || step.end;
    const auto* command = step.ask ? std::get_if<methods::CommandCall>(&step.ask->call.what) : nullptr;
    const owner::CommandKey& open = record_.open()->key;
    return command && command->owner == record_.open()->owner && open.attempt == request.key.attempt &&
           open.activity == Calls::activity_of(request, step.ask->number);
  }

  static method_run::End end_of(const owner::CommandStatus& why) {
    return {.error = why.code.empty() ? "stopped" : why.code};
  }

  // What is shown of a command that the ledger knows as ended.
  temporal::Value state_at_death(const Step* step) const {
    const MethodRun& run = under_way_->run;
    if (under_way_->broken_off) return run.failed(end_of(*under_way_->broken_off), methods_.rest);
    if (!step || !step->end) return run.failed({.error = "owner-restarted"}, methods_.rest);
    return step->end->error.empty() ? run.then(methods_.rest) : run.failed(*step->end, methods_.rest);
  }

  // A request may be there before the first timer.
  void catch_up() override { begin_life(); }

  void begin_life() {
    if (std::exchange(alive_, true)) return;
    if (record_.damaged())
      tell("calls.damaged", "what an earlier process commanded is not known: its record cannot be read");
    if (kept_) {
      show(under_way_->run.during());
      commands_.say_again(under_way_->request.key);
      if (under_way_->broken_off) return go_on_with_kept();
      kept_->timer = node_.after(kAskedWithin, [this] { give_up_kept(); });
      return;
    }
    show(record_.state().value_or(temporal::state(methods_.rest.name, methods_.rest.arguments)));
    if (ended_before_) commands_.say_again(*ended_before_);
    settle();
  }

  void settle() {
    if (record_.open())
      tell("calls.settling",
           "asks " + record_.open()->owner + " what became of " + record_.open()->key.activity);
    calls_.settle([this] { settled(); });
  }

  // A commander that still wants it asks; what was observed is heard first.
  void asked_about(const owner::CommandKey& key) override {
    if (!kept_ || kept_->asked || under_way_->request.key != key) return;
    kept_->asked = true;
    node_.cancel(kept_->timer);
    kept_->timer = node_.after(kHear, [this] { go_on_with_kept(); });
  }

  void go_on_with_kept() {
    const Kept kept = *std::exchange(kept_, std::nullopt);
    settled_ = true;
    tell("calls.resumed",
         "goes on with " + under_way_->request.command + " " + under_way_->request.key.activity);
    if (under_way_->broken_off && !record_.open()) return finish_early({});
    if (kept.step.end) return finish(*kept.step.end);
    const std::string repairing = under_way_->run.repairing();
    if (!repairing.empty() && !under_way_->broken_off &&
        !commands_.repair(under_way_->request.key, repairing)) {
      if (!record_.open()) return finish(under_way_->run.forbid_repair());
      under_way_->broken_off = {
          Stage::failed, "repair-overrun", "the step's time was over before the repair was", {}};
    }
    calls_.resume(*kept.step.ask, under_way_->request, kept.call_begun,
                  [this](const method_run::Answer& answer) { take(answer); });
    if (under_way_->broken_off) calls_.break_off();
  }

  // Nobody asks for it any more: what it had commanded is ended before anything new begins.
  void give_up_kept() {
    kept_.reset();
    end(under_way_->run.failed({.error = "owner-restarted"}, methods_.rest),
        {Stage::failed, "owner-restarted", "its owner was started anew while it ran", {}});
    settle();
  }

  void carry_out(const owner::Request& request) override {
    const auto method = methods_.methods.find(request.command);
    if (method == methods_.methods.end()) return reject(request, "unknown-command", unknown(request.command));
    for (const std::string& name : method->second.arguments)
      if (!request.arguments.contains(name))
        return reject(request, "wrong-arguments", request.command + " needs the argument '" + name + "'");
    if (kept_ && !kept_->asked) {
      node_.cancel(kept_->timer);
      give_up_kept();
    }
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
    keep([&] { record_.begin_run(request, node_.now()); });
    under_way_.emplace(UnderWay{request, MethodRun(method, request.arguments)});
    show(under_way_->run.during());
    go_on(under_way_->run.begin());
  }

  void settled() {
    settled_ = true;
    if (waiting_) begin();
  }

  void break_off(const owner::CommandKey& key, const owner::CommandStatus& why) override {
    if (waiting_ && waiting_->key == key) {
      waiting_.reset();
      commands_.say(key, why);
    } else if (under_way_ && under_way_->request.key == key && !under_way_->broken_off) {
      under_way_->broken_off = why;
      keep([&] { record_.break_off(why); });
      if (!kept_) return calls_.break_off();
      node_.cancel(kept_->timer);
      go_on_with_kept();
    }
  }

  void take(const method_run::Answer& answer) {
    const method_run::Observations observed = under_way_->run.needed(calls_.observed());
    keep([&] { record_.take({answer, observed}, node_.now()); });
    if (under_way_->broken_off) return finish_early(answer);
    go_on(under_way_->run.take(answer, observed));
  }

  void go_on(const Step& step) {
    if (step.end) return finish(*step.end);
    if (!step.repairing.empty() && !commands_.repair(under_way_->request.key, step.repairing))
      return finish(under_way_->run.forbid_repair());
    if (const temporal::Value now = under_way_->run.during(); now != shown_) show(now);
    calls_.begin(*step.ask, under_way_->request, [this](const method_run::Answer& answer) { take(answer); });
  }

  // The word that says why stands, whatever the call came to in the meantime.
  void finish_early(const method_run::Answer& answer) {
    owner::CommandStatus status = *under_way_->broken_off;
    status.results.values = answer.values;
    const temporal::Value state = under_way_->run.failed(end_of(status), methods_.rest);
    end(state, std::move(status));
  }

  void finish(const method_run::End& result) {
    owner::CommandStatus status{Stage::completed, "done", result.reason, {}};
    status.results.energy_j = result.energy_j;
    status.results.values = result.values;
    for (const auto& [timeline, value] : under_way_->run.told(result)) show(timeline, value);
    if (result.error.empty()) return end(under_way_->run.then(methods_.rest), std::move(status));
    status.stage = Stage::failed;
    status.code = result.error;
    end(under_way_->run.failed(result, methods_.rest), std::move(status));
  }

  void end(const temporal::Value& state, owner::CommandStatus status) {
    const owner::CommandKey key = under_way_->request.key;
    under_way_.reset();
    show(state);
    commands_.say(key, std::move(status));
    keep([&] { record_.end_run(state); });
  }

  // A robot that can still be commanded beats one that cannot.
  void keep(const std::function<void()>& write) try { write(); } catch (const std::system_error& error) {
    events_.write(services::node::make_event(v1::SEVERITY_WARNING, "calls.unwritten", error.what()));
  }

  void reject(const owner::Request& request, const std::string& code, const std::string& reason) {
    commands_.say(request.key, {Stage::rejected, code, reason, {}});
  }

  std::string unknown(const std::string& command) const {
    std::vector<std::string> known;
    for (const auto& [name, method] : methods_.methods) known.push_back(name);
    return "it has no method '" + command + "'" + words::did_you_mean(command, known);
  }

  void show(const temporal::Value& state) {
    shown_ = state;
    show(methods_.timeline, state);
  }
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
  std::optional<Kept> kept_;
  std::optional<owner::CommandKey> ended_before_;  // whose word may not have been heard
  bool alive_ = false;
  bool settled_ = false;
  temporal::Value shown_;  // of its own timeline
};

}  // namespace

std::unique_ptr<services::Service> make_service(services::Node& node, const services::RunSettings& settings) {
  return make_watched_service(node, settings, {});
}

std::unique_ptr<services::Service> make_watched_service(services::Node& node,
                                                        const services::RunSettings& settings,
                                                        std::function<void()> around_write) {
  const mission::Entry root = mission::load_mission_file(settings.mission_file());
  methods::check_sole_owner(root.at("dedicated"), settings.mission, node.options().name);
  return std::make_unique<DedicatedService>(node, methods::read_methods(root.at("dedicated")),
                                            read_spots(root), settings.run_folder, std::move(around_write));
}

}  // namespace roci::dedicated
