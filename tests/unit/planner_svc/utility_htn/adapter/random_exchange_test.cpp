// Engine and executive with messages between them that come late, in any order or not at all, and with the death of
// either (R66, R81): the engine goes on from what is executed, and in the end everything is done once.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <map>
#include <random>
#include <set>

#include "core/temporal/plan_delta.hpp"
#include "exec_svc/reactor/commitment.hpp"
#include "planner_svc/engine/version_exchange.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "tests/unit/planner_svc/utility_htn/cycle/toy_network.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

using namespace std::chrono_literals;
using engine::Receipt, engine::StepInputs, engine::StepOutput, engine::VersionExchange;
using temporal::ActivityState, temporal::FlexiblePlan, temporal::PlanActivity, temporal::PlanDelta,
    temporal::Time;

class Chances {
 public:
  explicit Chances(unsigned seed) : random_(seed) {}
  bool one_in(int n) { return static_cast<int>(random_() % static_cast<unsigned>(n)) == 0; }
  std::size_t below(std::size_t n) { return random_() % n; }

 private:
  std::mt19937 random_;
};

// Takes versions by the rules of exec_svc, and executes what is committed. Its plan and steps outlive it.
class Executive {
 public:
  explicit Executive(Chances& chances) : chances_(chances) {}

  void take(const PlanDelta& delta, Time now) {
    FlexiblePlan next = runs_ ? plan_ : FlexiblePlan{};
    std::string fault = delta.added.version <= version_ ? "it is known" : "";
    if (fault.empty()) fault = temporal::apply(delta, next);
    if (fault.empty() && !temporal::check(next).empty()) fault = temporal::check(next).front();
    for (const PlanActivity& activity : next.activities)
      if (fault.empty() && ended_.contains(activity.id)) fault = activity.id + " has ended before";
    if (fault.empty())
      fault = exec::reactor::commitment_violation(runs_ ? plan_ : FlexiblePlan{}, steps(), next, now);
    receipt_.refused = fault.empty() ? 0 : delta.added.version;
    receipt_.reason = fault;
    if (!fault.empty()) {
      ++refusals_;
      return;
    }
    plan_ = std::move(next);
    runs_ = true;
    receipt_.version = version_ = plan_.version;
    std::map<std::string, temporal::ActivityProgress> kept;
    for (const PlanActivity& activity : plan_.activities) kept[activity.id] = progress_[activity.id];
    progress_ = std::move(kept);
  }

  // Starts what is committed and whose time has come, and ends what has run for its duration;
  // now and then something fails.
  void execute(Time now) {
    if (!runs_) return;
    for (const PlanActivity& activity : plan_.activities) {
      temporal::ActivityProgress& one = progress_[activity.id];
      if (one.state == ActivityState::running && now >= *one.started + activity.duration_lower)
        end(activity, chances_.one_in(15) ? ActivityState::failed : ActivityState::succeeded, now);
    }
    for (const PlanActivity& activity : plan_.activities) {
      if (progress_[activity.id].state != ActivityState::waiting) continue;
      if (activity.commit != temporal::CommitState::committed || now < plan_.origin + earliest(activity))
        continue;
      if (const PlanActivity* before = before_of(activity)) {
        const ActivityState state = progress_[before->id].state;
        if (state != ActivityState::succeeded) {
          if (temporal::is_over(state)) end(activity, ActivityState::skipped, now);
          continue;
        }
      } else if (const auto id = task_of(activity.id); id && cycle::link_of(*id) > 0) {
        end(activity, ActivityState::skipped, now);  // what it follows has failed and left the plan
        continue;
      }
      progress_[activity.id] = {ActivityState::running, now, std::nullopt};
    }
    const bool over =
        std::ranges::all_of(progress_, [](const auto& one) { return temporal::is_over(one.second.state); });
    if (!over) return;
    for (const auto& [id, progress] : progress_) ended_.insert(id);
    runs_ = false;
    receipt_.version = 0;
  }

  const Receipt& receipt() const { return receipt_; }
  /// The newest, also when it has ended: who comes late reads it.
  const FlexiblePlan* plan() const { return version_ != 0 ? &plan_ : nullptr; }
  const std::map<std::string, temporal::ActivityProgress>& progress() const { return progress_; }
  const std::vector<std::string>& done() const { return done_; }
  std::size_t refusals() const { return refusals_; }

 private:
  std::vector<exec::executive::StepStatus> steps() const {
    std::vector<exec::executive::StepStatus> out;
    if (!runs_) return out;
    for (const PlanActivity& activity : plan_.activities) {
      exec::executive::StepStatus& one = out.emplace_back();
      const temporal::ActivityProgress& progress = progress_.at(activity.id);
      one.activity = activity.id;
      one.state = progress.state;
      one.started = progress.started;
      one.ended = progress.ended;
    }
    return out;
  }
  void end(const PlanActivity& activity, ActivityState state, Time now) {
    temporal::ActivityProgress& one = progress_[activity.id];
    one.state = state;
    one.ended = now;
    if (state == ActivityState::succeeded && !is_initial(activity)) done_.push_back(activity.name);
  }
  temporal::Duration earliest(const PlanActivity& activity) const {
    temporal::Duration out{0};
    for (const temporal::TemporalConstraint& one : plan_.constraints)
      if (one.from_point == temporal::origin_point && one.to_point == activity.start_point)
        out = std::max(out, one.lower);
    return out;
  }
  const PlanActivity* before_of(const PlanActivity& activity) const {
    for (const temporal::TemporalConstraint& one : plan_.constraints) {
      if (one.to_point != activity.start_point || one.from_point == temporal::origin_point) continue;
      const auto found = std::ranges::find(plan_.activities, one.from_point, &PlanActivity::end_point);
      if (found != plan_.activities.end()) return &*found;
    }
    return nullptr;
  }

  Chances& chances_;
  FlexiblePlan plan_;
  bool runs_ = false;
  std::uint32_t version_ = 0;
  Receipt receipt_{0, 0, "", "", true};
  std::map<std::string, temporal::ActivityProgress> progress_;
  std::set<std::string> ended_;
  std::vector<std::string> done_;
  std::size_t refusals_ = 0;
};

// Both sides and what is on the way between them. State topics keep the newest sample alone, each comes when it likes.
class World {
 public:
  explicit World(unsigned seed) : chances_(seed) { start_planner(); }

  void run(int seconds, bool quiet) {
    for (int i = 0; i < seconds; ++i) {
      now_ += 1s;
      executive_.execute(now_);
      publish();
      if (quiet) hangs_ = false;
      if (!quiet) misfortune();
      const auto comes = [&] { return quiet || !chances_.one_in(3); };
      while (!deltas_.empty() && !hangs_ && comes()) {
        executive_.take(deltas_.front(), now_);
        deltas_.pop_front();
        publish();
      }
      if (receipt_ && comes()) exchange_.hear(*std::exchange(receipt_, std::nullopt));
      if (plan_ && comes()) hear_plan();
      std::erase_if(steps_, [&](const auto& one) {
        if (!comes()) return false;
        heard_.steps.push_back({0, one.first, one.second, "", 1});
        return true;
      });
      if (quiet || comes()) step(quiet);
    }
  }

  const std::vector<std::string>& done() const { return executive_.done(); }
  std::size_t versions() const { return sent_; }
  std::size_t refusals() const { return executive_.refusals(); }
  const Receipt& receipt() const { return executive_.receipt(); }

 private:
  void start_planner() {
    engine_ = std::make_unique<UtilityEngine>(engine::Setup{"utility_htn", "lander", "", ""},
                                              testing::toy_network());
    heard_ = {};
    engine::Goal mission;
    mission.issuer = "ground";
    mission.id = mission.kind = "mission";
    heard_.goals.push_back(mission);
    heard_.observations.push_back({"health", temporal::state("works"), now_});
    for (const auto& [id, progress] : executive_.progress()) known_steps_[id] = progress;
  }

  void publish() {
    if (told_receipt_ != executive_.receipt()) receipt_ = told_receipt_ = executive_.receipt();
    if (const FlexiblePlan* plan = executive_.plan(); plan != nullptr && plan->version != told_plan_) {
      plan_ = *plan;
      told_plan_ = plan->version;
    }
    for (const auto& [id, progress] : executive_.progress()) {
      const auto known = known_steps_.find(id);
      if (known != known_steps_.end() && known->second.state == progress.state) continue;
      steps_[id] = known_steps_[id] = progress;
    }
  }

  void hear_plan() { exchange_.take(*std::exchange(plan_, std::nullopt)); }

  // One of the two dies, or the executive hangs, or what is on the way is lost, or the engine fails at something.
  void misfortune() {
    if (chances_.one_in(40)) hangs_ = !hangs_;
    if (chances_.one_in(150)) {  // the executive; it says again what it knows
      deltas_.clear();
      told_receipt_.reset();
      told_plan_ = 0;
      known_steps_.clear();
    }
    if (chances_.one_in(150)) {  // the planner; it hears all that is kept
      exchange_ = {};
      start_planner();
      receipt_ = executive_.receipt();
      // A plan that has ended must not come after the word that it has: nothing says that there was one.
      if (executive_.plan() != nullptr) exchange_.take(*executive_.plan());
      plan_.reset();
      steps_.insert(executive_.progress().begin(), executive_.progress().end());
    }
    if (chances_.one_in(150)) {  // the engine alone
      start_planner();
      exchange_.engine_is_new();
    }
  }

  void step(bool quiet) {
    StepInputs inputs = std::exchange(heard_, {});
    inputs.now = now_;
    exchange_.give(inputs);
    if (inputs.executed)  // as SteppedHost does
      for (const auto& [id, progress] : executive_.progress())
        if (!steps_.contains(id)) inputs.steps.push_back({0, id, progress, "", 0});
    const StepOutput out = engine_->step(inputs);
    if (!out.delta) return;
    FlexiblePlan next;
    const std::string fault = exchange_.apply(*out.delta, next);
    EXPECT_EQ(fault, "") << "a planner.defect";
    const bool all_heard = !receipt_ && !plan_ && deltas_.empty();
    if (all_heard) {
      EXPECT_EQ(out.delta->from_version, executive_.receipt().version) << "at " << now_.count();
    }
    if (!fault.empty()) return;
    if (!quiet && chances_.one_in(30)) return exchange_.refuse(out.delta->added.version, "by the checker");
    exchange_.sent(next);
    ++sent_;
    if (quiet || !chances_.one_in(10)) deltas_.push_back(*out.delta);
  }

  Chances chances_;
  Executive executive_{chances_};
  VersionExchange exchange_;
  std::unique_ptr<UtilityEngine> engine_;
  StepInputs heard_;
  std::deque<PlanDelta> deltas_;
  std::optional<Receipt> receipt_, told_receipt_;
  std::optional<FlexiblePlan> plan_;
  std::uint32_t told_plan_ = 0;
  std::map<std::string, temporal::ActivityProgress> steps_, known_steps_;
  bool hangs_ = false;
  std::size_t sent_ = 0;
  Time now_{0};
};

TEST(RandomExchange, TheEngineGoesOnFromWhatIsExecutedAndEverythingIsDoneOnce) {
  std::size_t versions = 0;
  for (unsigned seed = 1; seed <= 300; ++seed) {
    SCOPED_TRACE(seed);
    World world(seed);
    world.run(600, false);
    world.run(100, true);
    const std::size_t refusals = world.refusals();
    world.run(1500, true);
    EXPECT_EQ(world.refusals(), refusals) << world.receipt().reason;
    EXPECT_EQ(world.receipt().version, 0U) << "what there is to do is done";
    for (const char* what : {"send_sample", "send_view", "idle"})
      EXPECT_LE(std::ranges::count(world.done(), what), 1) << what;
    versions += world.versions();
    if (::testing::Test::HasFailure()) break;
  }
  EXPECT_GT(versions, 300U);
}

}  // namespace
}  // namespace roci::planner::utility_htn::adapter
