#include "bench/europa/prescient.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "planner_svc/utility_htn/flattening/chain.hpp"

namespace roci::bench::europa {

namespace model = planner::utility_htn::model;
using planner::utility_htn::flattening::Chain, planner::utility_htn::flattening::Chains;
using temporal::timelines::Constraint, temporal::timelines::Kind;

namespace {

// So many choices are looked at before the best so far is told without a proof.
constexpr std::uint64_t kMostChoices = 20'000'000;
constexpr double kLeastGain = 1e-9;

// What is known of a discovery among the chains chosen so far.
struct Shown {
  Discovery discovery;
  int analysed = 0, taken = 0;  // chains
};

// What one chain adds to each discovery.
struct Part {
  std::size_t discovery = 0;
  int analysed = 0, taken = 0;
};

// Chooses request by request, depth first; what cannot beat the best any more is left out.
class Choice {
 public:
  explicit Choice(const Foreknowledge& known)
      : known_(known),
        network_(known.network),
        chains_(planner::utility_htn::flattening::flatten(known.network)),
        values_(model::priors(known.network)),
        counts_(network_.tasks.size()),
        successes_(network_.tasks.size()),
        uses_(network_.timelines.size()) {
    for (const auto& timeline : network_.timelines) state_.push_back(timeline.initial);
    find_requests();
    find_discoveries();
    find_bounds();
    find_fixed();
    const double from = temporal::to_seconds(network_.cycle.commit_window);
    std::ranges::fill(uses_, from);
    length_ = from;
  }

  Prescience run() {
    best_.proven = true;
    descend(0);
    return std::move(best_);
  }

 private:
  struct Request {
    model::TaskIndex task = 0;
    std::vector<std::size_t> chains{};  // the most useful first
    bool like_before = false;           // the same as the one before it, and open later
  };

  void find_requests() {
    std::map<model::TaskIndex, Request> found;
    for (std::size_t index = 0; index < chains_.chains.size(); ++index) {
      const Chain& chain = chains_.chains[index];
      worth_.push_back(planner::utility_htn::flattening::utility(network_, chain, values_)[0]);
      if (network_.tasks[chain.task].fixed) continue;
      found[chain.task].task = chain.task;
      found[chain.task].chains.push_back(index);
    }
    for (auto& [task, request] : found) {
      if (!requests_.empty()) request.like_before = repeats(requests_.back(), request);
      requests_.push_back(request);
    }
    // By batch, as the network has them: what permits the rest comes first.
    std::ranges::stable_sort(requests_, {},
                             [&](const Request& one) { return network_.tasks[one.task].batch; });
    for (Request& one : requests_)
      std::ranges::stable_sort(one.chains, std::greater{}, [&](std::size_t index) { return worth_[index]; });
  }

  bool repeats(const Request& before, const Request& one) const {
    const model::Task &first = network_.tasks[before.task], &second = network_.tasks[one.task];
    if (first.batch != second.batch || first.opens > second.opens || temporal::bounded(first.closes))
      return false;
    return std::ranges::equal(before.chains, one.chains, [&](std::size_t a, std::size_t b) {
      return chains_.chains[a].links == chains_.chains[b].links &&
             chains_.chains[a].when == chains_.chains[b].when;
    });
  }

  void find_discoveries() {
    parts_.resize(chains_.chains.size());
    if (!known_.discovery) return;
    std::map<std::string, std::size_t> by_parameter;
    for (const model::Task& task : network_.tasks) {
      const auto found = known_.discovery(task.id);
      if (found && by_parameter.emplace(found->parameter, shown_.size()).second) shown_.push_back({*found});
    }
    for (std::size_t index = 0; index < chains_.chains.size(); ++index)
      for (std::size_t which = 0; which < shown_.size(); ++which) {
        Part part{which};
        for (const model::Subtask& link : chains_.chains[index].links) {
          const model::Task& task = network_.tasks[link.task];
          const auto found = known_.discovery(task.id);
          part.analysed += found && found->parameter == shown_[which].discovery.parameter ? 1 : 0;
          if (task.utility.empty() || !task.utility.front().parameter) continue;
          const auto& parameter = network_.parameters[*task.utility.front().parameter];
          part.taken += parameter.name == shown_[which].discovery.parameter ? 1 : 0;
        }
        if (part.analysed + part.taken > 0) parts_[index].push_back(part);
      }
  }

  // The most that all requests from one on can bring.
  void find_bounds() {
    most_.assign(requests_.size() + 1, 0);
    for (std::size_t i = requests_.size(); i-- > 0;)
      most_[i] = most_[i + 1] + std::max(0.0, worth_[requests_[i].chains.front()]);
    for (const Shown& one : shown_) most_discovered_ += one.discovery.more;
  }

  // What has a fixed time and runs to the end draws as long as the mission lasts.
  void find_fixed() {
    for (const model::Task& task : network_.tasks) {
      if (!task.fixed || !task.primitive()) continue;
      const double seconds = model::duration_s(task, values_);
      const double start = temporal::to_seconds(task.preferred_start);
      if (start + seconds < temporal::to_seconds(network_.cycle.plan_end) - 1) continue;
      fixed_.emplace_back(start, model::cost(network_, task, values_) / seconds);
    }
  }

  double fixed() const {
    double out = 0;
    for (const auto& [start, watts] : fixed_) out += watts * std::max(0.0, length() - start);
    return out;
  }

  double length() const { return std::max(length_, *std::ranges::max_element(uses_)); }

  double discovered() const {
    double out = 0;
    for (const Shown& one : shown_)
      if (one.analysed > 0 && one.taken > 0) out += one.discovery.more;
    return out;
  }

  const Success& success(model::TaskIndex task, std::size_t which) {
    std::vector<Success>& mine = successes_[task];
    if (which >= mine.size()) mine = successes(known_, network_.tasks[task], which + 8);
    return mine[which];
  }

  bool selected(const Chain& chain) const {
    return std::ranges::all_of(chain.when, [&](const Constraint& one) {
      const double value = state_[one.timeline];
      if (network_.timelines[one.timeline].kind == Kind::state)
        return ((one.states >> static_cast<unsigned>(value)) & 1U) != 0;
      return one.lowest <= value && value <= one.highest;
    });
  }

  // All that choosing a chain changes, to be taken back.
  struct Before {
    double length, energy, recovery;
    std::vector<double> state, uses;
  };

  Before add(std::size_t index) {
    const Chain& chain = chains_.chains[index];
    Before before{length_, energy_, recovery_, state_, uses_};
    double ends = std::max(temporal::to_seconds(network_.cycle.commit_window),
                           temporal::to_seconds(network_.tasks[chain.task].opens));
    for (const model::Subtask& link : chain.links) {
      const model::Task& task = network_.tasks[link.task];
      const Success& one = success(link.task, counts_[link.task]++);
      energy_ += one.energy;
      recovery_ += one.recovery;
      ends += model::duration_s(task, values_);
      for (const model::Impact& impact : task.impacts) {
        const double amount = model::evaluate(impact.amount, values_);
        if (network_.timelines[impact.timeline].kind == Kind::atomic) {
          uses_[impact.timeline] += one.seconds;
        } else if (impact.kind == temporal::ImpactKind::assign) {
          state_[impact.timeline] = amount;
        } else if (impact.kind == temporal::ImpactKind::delta && impact.timeline != network_.budget) {
          state_[impact.timeline] += amount;
        }
      }
    }
    length_ = std::max(length_, ends);
    count_parts(index, 1);
    chosen_.push_back(index);
    return before;
  }

  void take_back(std::size_t index, Before before) {
    for (const model::Subtask& link : chains_.chains[index].links) --counts_[link.task];
    length_ = before.length;
    energy_ = before.energy;
    recovery_ = before.recovery;
    state_ = std::move(before.state);
    uses_ = std::move(before.uses);
    count_parts(index, -1);
    chosen_.pop_back();
  }

  void count_parts(std::size_t index, int sign) {
    for (const Part& part : parts_[index]) {
      shown_[part.discovery].analysed += sign * part.analysed;
      shown_[part.discovery].taken += sign * part.taken;
    }
  }

  bool affordable() const {
    return energy_ + recovery_ + fixed() < known_.budget &&
           length() <= temporal::to_seconds(network_.cycle.plan_end);
  }

  void descend(std::size_t depth) {
    if (++choices_ > kMostChoices) {
      best_.proven = false;
      return;
    }
    const double here = utility_ + discovered();
    if (here > best_.utility + kLeastGain) keep(here);
    if (depth == requests_.size()) return;
    if (utility_ + most_discovered_ + most_[depth] <= best_.utility + kLeastGain) return;
    const Request& request = requests_[depth];
    if (!request.like_before || taken_before_) {
      for (const std::size_t index : request.chains) {
        if (!selected(chains_.chains[index])) continue;
        Before before = add(index);
        utility_ += worth_[index];
        if (affordable()) {
          taken_before_ = true;
          descend(depth + 1);
        }
        utility_ -= worth_[index];
        take_back(index, std::move(before));
      }
    }
    taken_before_ = false;
    descend(depth + 1);
  }

  void keep(double utility) {
    best_.utility = utility;
    best_.discovered = discovered();
    best_.energy = energy_;
    best_.recovery = recovery_;
    best_.fixed = fixed();
    best_.tasks = 0;
    for (std::size_t task = 0; task < counts_.size(); ++task)
      if (!network_.tasks[task].commands.empty()) best_.tasks += static_cast<double>(counts_[task]);
    best_.chains.clear();
    for (const std::size_t index : chosen_) best_.chains.push_back(chains_.chains[index].name);
  }

  const Foreknowledge& known_;
  const model::Network& network_;
  Chains chains_;
  model::Values values_;
  std::vector<double> worth_;             // by chain
  std::vector<std::vector<Part>> parts_;  // likewise
  std::vector<Request> requests_;
  std::vector<double> most_;  // by request
  double most_discovered_ = 0;
  std::vector<std::pair<double, double>> fixed_;  // start and power
  std::vector<Shown> shown_;
  // What is chosen so far.
  std::vector<std::size_t> chosen_;
  std::vector<std::size_t> counts_;              // by task
  std::vector<std::vector<Success>> successes_;  // likewise, as far as they were asked for
  std::vector<double> state_, uses_;             // by timeline
  double length_ = 0, energy_ = 0, recovery_ = 0, utility_ = 0;
  bool taken_before_ = false;
  Prescience best_;
  std::uint64_t choices_ = 0;
};

}  // namespace

std::vector<Success> successes(const Foreknowledge& known, const model::Task& task, std::size_t count) {
  const model::Values values = model::priors(known.network);
  const double energy = model::cost(known.network, task, values), seconds = model::duration_s(task, values);
  std::vector<Success> out;
  for (std::uint32_t execution = 0; out.size() < count; ++execution) {
    // What commands nothing neither fails nor differs from its model.
    const Fate fate = task.commands.empty() ? Fate{} : known.fates(task.id, execution);
    const double here = fate.energy * energy, length = fate.duration * seconds;
    switch (fate.failure) {
      case Resolution::none:
        out.push_back({here, 0, length});
        break;
      case Resolution::flexible:
        out.push_back({here, here, 2 * length});
        break;
      case Resolution::ground:
        out.push_back(
            {here, here + known.costs.ground_j, 2 * length + temporal::to_seconds(known.costs.ground_wait)});
        break;
      case Resolution::replanning: {
        const Fate next = known.fates(task.id, ++execution);
        out.push_back(
            {next.energy * energy, here + known.costs.replanning_j, length + next.duration * seconds});
        break;
      }
    }
  }
  return out;
}

Prescience prescient(const Foreknowledge& known) { return Choice(known).run(); }

}  // namespace roci::bench::europa
