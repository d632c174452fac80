#include "planner_svc/utility_htn/flattening/reach.hpp"

#include <algorithm>
#include <cstdint>

namespace roci::planner::utility_htn::flattening {

using model::Network, model::Subtask, model::TaskIndex;
using temporal::timelines::Constraint, temporal::timelines::Index, temporal::timelines::Kind;

namespace {

using States = std::vector<std::uint64_t>;  // by timeline, bit i: state i

std::uint64_t bit_of(double state) {
  return state >= 0 && state < 64 ? std::uint64_t{1} << static_cast<unsigned>(state + 0.5) : 0;
}

class Relaxation {
 public:
  Relaxation(const Network& network, const Chains& chains, const model::Values& values,
             const Prospects& prospects)
      : network_(network),
        chains_(chains),
        values_(values),
        reached_(network.timelines.size(), ~std::uint64_t{0}) {
    for (const model::Task& task : network.tasks)
      for (const model::Impact& impact : task.impacts)
        if (is_state(impact.timeline))
          reached_[impact.timeline] = bit_of(prospects.timelines_now[impact.timeline]);
    for (const TaskIndex task : prospects.under_way) add_assigned(task, reached_);
    for (std::uint32_t chain = 0; chain < chains.chains.size(); ++chain)
      if (prospects.open.contains(chains.chains[chain].task)) unreached_.push_back(chain);
  }

  std::set<TaskIndex> run(const std::set<TaskIndex>& open) {
    std::set<TaskIndex> out = open;
    for (bool again = true; again;) {
      const std::size_t before = unreached_.size();
      std::erase_if(unreached_, [&](std::uint32_t chain) {
        if (!possible(chains_.chains[chain])) return false;
        out.erase(chains_.chains[chain].task);
        return true;
      });
      again = unreached_.size() < before;
    }
    return out;
  }

 private:
  bool is_state(Index timeline) const { return network_.timelines[timeline].kind == Kind::state; }

  void add_assigned(TaskIndex task, States& states) const {
    for (const model::Impact& impact : network_.tasks[task].impacts)
      if (is_state(impact.timeline))
        states[impact.timeline] |= bit_of(model::evaluate(impact.amount, values_));
  }

  // Takes over what the chain assigns if it is.
  bool possible(const Chain& chain) {
    States with = reached_;
    for (const Subtask& link : chain.links) add_assigned(link.task, with);
    const auto holds = [&](const Constraint& one) {
      return !is_state(one.timeline) || (with[one.timeline] & one.states) != 0;
    };
    const bool out =
        std::ranges::all_of(chain.when, holds) && std::ranges::all_of(chain.links, [&](const Subtask& link) {
          return std::ranges::all_of(network_.tasks[link.task].constraints, holds);
        });
    if (out) reached_ = std::move(with);
    return out;
  }

  const Network& network_;
  const Chains& chains_;
  const model::Values& values_;
  States reached_;
  std::vector<std::uint32_t> unreached_;  // chains
};

}  // namespace

std::set<TaskIndex> out_of_reach(const Network& network, const Chains& chains, const model::Values& values,
                                 const Prospects& prospects) {
  return Relaxation(network, chains, values, prospects).run(prospects.open);
}

}  // namespace roci::planner::utility_htn::flattening
