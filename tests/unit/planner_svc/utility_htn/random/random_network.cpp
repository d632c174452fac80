#include "tests/unit/planner_svc/utility_htn/random/random_network.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace roci::planner::utility_htn {

using model::Amount, model::Contingency, model::Decomposition, model::Impact, model::Measure, model::Network,
    model::ParameterIndex, model::Subtask, model::Task, model::TaskIndex, model::Tier;
using temporal::ImpactKind, temporal::ImpactWhen;
using temporal::timelines::Constraint, temporal::timelines::Definition, temporal::timelines::Kind,
    temporal::timelines::Phase;

namespace {

class Maker {
 public:
  explicit Maker(std::mt19937_64& random) : random_(random) {}

  Network make() {
    out_.name = "random";
    out_.version = below(1000);
    for (std::size_t i = 0; i <= below(4); ++i) out_.ranks.push_back("rank_" + std::to_string(i));
    for (std::size_t i = 0; i < below(4); ++i) out_.batches.push_back("batch-" + std::to_string(i));
    for (std::size_t i = 0; i < below(6); ++i) parameter(i);
    timelines();
    const std::size_t primitives = 3 + below(6), parents = below(5);
    for (std::size_t i = 0; i < primitives + parents; ++i) {
      out_.tasks.emplace_back().is_template = chance(2);
      out_.tasks.back().id = "task_" + std::to_string(i);
    }
    out_.tasks[0].is_template = true;
    out_.tasks[1].is_template = false;
    for (std::size_t i = 0; i < out_.tasks.size(); ++i) {
      common(out_.tasks[i]);
      if (i < primitives) {
        primitive(out_.tasks[i]);
      } else {
        parent(out_.tasks[i], i);
      }
    }
    if (chance(2)) subway();
    out_.cycle = {temporal::seconds(10), temporal::seconds(2.5), temporal::seconds(20.125),
                  chance(2) ? temporal::no_bound : temporal::seconds(100), temporal::seconds(1e6)};
    out_.exploration_bound = 1 + below(1'000'000);
    return std::move(out_);
  }

 private:
  std::size_t below(std::size_t bound) { return random_() % bound; }
  bool chance(std::size_t one_in) { return below(one_in) == 0; }
  // Whole ones, fractions, and such as need all their digits.
  double number(double lowest, double highest) {
    const double at = lowest + (highest - lowest) * static_cast<double>(below(1'000'001)) / 1e6;
    return chance(2) ? std::clamp(static_cast<double>(static_cast<long>(at)), lowest, highest) : at;
  }
  std::string text() {
    static const std::array<std::string, 8> all{
        "", "plain", "braces {x} }{", "\"quoted\" \\ back", "ümläut — ß", "a: b # c", "'", "- {site}"};
    return all[below(all.size())];
  }
  temporal::Duration time() { return temporal::Duration{static_cast<std::int64_t>(below(10'000'000'000))}; }

  void parameter(std::size_t i) {
    const double lowest = number(0, 50);
    const double highest = lowest + number(1, 50);
    out_.parameters.push_back({"p" + std::to_string(i) + ".x-y",
                               std::clamp(number(lowest, highest), lowest, highest), lowest, highest,
                               text()});
  }

  void timelines() {
    out_.timelines.push_back({"battery", Kind::cumulative_rate, {}, 900, 0, 1e6, true});
    out_.timelines.push_back({"signature", Kind::state, {"unknown", "negative", "positive"}, 1});
    out_.timelines.push_back({"arm", Kind::atomic, {}, 0, 0, 1, chance(2)});
    out_.timelines.push_back({"power", Kind::claimable, {}, 0, 0, 500.5, chance(2)});
    out_.timelines.push_back({"bytes", Kind::cumulative, {}, -3, -1e5});
    out_.timelines.push_back({"phase", Kind::state, {"a", "b-c", "d.e"}, 2});
    out_.timelines.back().reported = chance(2);
  }

  Amount amount(double lowest, double highest) {
    if (out_.parameters.empty() || highest < 200 || chance(2)) return {number(lowest, highest), {}, 1};
    return {number(0, 10), static_cast<ParameterIndex>(below(out_.parameters.size())),
            chance(2) ? 1.0 : number(0, 1)};
  }

  Constraint constraint(Phase phase) {
    Constraint out;
    out.phase = phase;
    out.timeline = static_cast<temporal::timelines::Index>(below(out_.timelines.size()));
    const Definition& timeline = out_.timelines[out.timeline];
    if (timeline.kind == Kind::state) {
      out.states = 1 + below((std::size_t{1} << timeline.states.size()) - 1);
      return out;
    }
    const double lowest = number(0, 1), highest = lowest + number(0, 10);
    const std::size_t form = below(4);
    if (form != 1) out.lowest = lowest;
    if (form != 2) out.highest = form == 3 ? lowest : highest;
    return out;
  }

  std::vector<Constraint> starts(std::size_t most) {
    std::vector<Constraint> out(below(most + 1));
    for (Constraint& one : out) one = constraint(Phase::pre);
    return out;
  }

  temporal::PlanCommand command() {
    temporal::PlanCommand out{"sim_svc", text(), text(), "do", {}, temporal::no_bound};
    for (std::size_t i = 0; i < below(3); ++i) out.arguments.push_back({"a" + std::to_string(i), text()});
    if (chance(2)) out.answer_within = temporal::seconds(1.5);
    return out;
  }

  Impact impact() {
    const auto timeline = static_cast<temporal::timelines::Index>(below(out_.timelines.size()));
    const auto at = chance(2) ? ImpactWhen::at_start : ImpactWhen::at_end;
    switch (out_.timelines[timeline].kind) {
      case Kind::atomic:
        return {timeline, ImpactKind::delta, ImpactWhen::during, {1, {}, 1}};
      case Kind::state:
        return {timeline, ImpactKind::assign, at, {static_cast<double>(below(3)), {}, 1}};
      case Kind::claimable:
        return {timeline, ImpactKind::delta, ImpactWhen::during, amount(0, 500)};
      case Kind::cumulative:
        return {timeline, chance(2) ? ImpactKind::delta : ImpactKind::assign, at, amount(-100, 300)};
      default:
        break;
    }
    if (chance(3))
      return {timeline, ImpactKind::delta, chance(2) ? at : ImpactWhen::during, amount(-100, 300)};
    return {timeline, ImpactKind::rate, chance(2) ? at : ImpactWhen::during, {number(-5, 5), {}, 1}};
  }

  TaskIndex any(bool is_template) {
    std::vector<TaskIndex> those;
    for (TaskIndex i = 0; i < out_.tasks.size(); ++i)
      if (out_.tasks[i].is_template == is_template) those.push_back(i);
    return those[below(those.size())];
  }

  void common(Task& task) {
    task.name = text();
    task.priority = static_cast<std::int32_t>(below(21)) - 10;
    task.batch = static_cast<std::uint32_t>(below(std::max<std::size_t>(1, out_.batches.size())));
    if (chance(3)) task.closes = temporal::seconds(5e4);
    if (chance(3)) task.preferred_start = time();
    task.fixed = temporal::bounded(task.preferred_start) && chance(2);
  }

  void primitive(Task& task) {
    for (std::size_t i = 0; i < below(3); ++i) task.commands.push_back(command());
    if (chance(3)) task.response = command();
    if (chance(3)) task.contingency = Contingency{{any(true)}, {}};
    if (task.contingency && chance(2)) task.contingency->withdraws = {any(false)};
    task.duration = amount(0, 1000);
    for (std::size_t i = 0; i < below(4); ++i) task.impacts.push_back(impact());
    for (const Phase phase : {Phase::pre, Phase::maintenance, Phase::post})
      for (std::size_t i = 0; i < below(3); ++i) task.constraints.push_back(constraint(phase));
    if (chance(2))
      task.control = {time(), temporal::seconds(0.000001), static_cast<std::uint32_t>(below(9)), chance(2),
                      starts(2)};
    for (std::size_t i = 0; i < below(out_.ranks.size() + 1); ++i) task.utility.push_back(amount(0, 1));
    for (std::size_t i = 0; i < below(3); ++i) {
      std::vector<double> scores(below(out_.ranks.size() + 1));
      for (double& score : scores) score = number(0, 1);
      task.products.push_back({"product" + std::to_string(i), static_cast<Tier>(below(4)), amount(0, 1e6),
                               temporal::RankVector(scores)});
    }
    task.downlinks = chance(4);
    if (!out_.parameters.empty() && chance(2))
      task.learns = {{Measure::duration_s, 0},
                     {Measure::power, static_cast<ParameterIndex>(out_.parameters.size() - 1)}};
    if (!out_.parameters.empty() && chance(3))
      task.learns.push_back({Measure::value, static_cast<ParameterIndex>(below(out_.parameters.size())),
                             "result-" + std::to_string(below(3))});
  }

  void parent(Task& task, std::size_t own) {
    for (std::size_t i = 0; i <= below(3); ++i) {
      Decomposition& out = task.decompositions.emplace_back();
      out.name = "way-" + std::to_string(i);
      out.when = starts(2);
      for (std::size_t j = 0; j <= below(3); ++j) {
        Subtask& subtask = out.subtasks.emplace_back();
        subtask.task = static_cast<TaskIndex>(below(own));
        if (j == 0 || chance(2)) continue;
        subtask.shortest_gap = time();
        if (chance(2)) subtask.longest_gap = subtask.shortest_gap + time();
      }
    }
  }

  void subway() {
    out_.subway.most_samples = static_cast<std::uint32_t>(1 + below(5));
    out_.subway.rank = static_cast<std::uint32_t>(below(out_.ranks.size()));
    for (std::size_t i = 0; i < below(3); ++i)
      out_.subway.sites.push_back({"site" + std::to_string(i),
                                   amount(0, 1),
                                   {{any(false), 1, amount(0, 1)}, {any(false), 1, amount(0, 1)}}});
    if (out_.subway.sites.empty()) out_.subway = {};
  }

  std::mt19937_64& random_;
  Network out_;
};

}  // namespace

Network random_network(std::mt19937_64& random) { return Maker(random).make(); }

}  // namespace roci::planner::utility_htn
