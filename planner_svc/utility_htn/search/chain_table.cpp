#include "planner_svc/utility_htn/search/chain_table.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "planner_svc/utility_htn/search/score.hpp"

namespace roci::planner::utility_htn::search {

using flattening::Chain;
using model::Subtask, model::Task, model::TaskIndex;
using temporal::bounded, temporal::plus, temporal::RankVector, temporal::Time;

ChainTable::ChainTable(const Problem& problem) : problem_(problem) {
  const std::size_t count = problem.chains.chains.size();
  costs_.reserve(count);
  contextual_.reserve(count);
  utilities_.resize(count);
  links_.resize(count);
  taken_.resize(problem.network.tasks.size());
  for (const TaskIndex request : problem.closed) taken_.at(request) = true;
  for (const Placed& placed : problem.committed) taken_.at(chain(placed.chain).task) = true;

  std::vector<double> of_tasks;
  for (const Task& task : problem.network.tasks)
    of_tasks.push_back(model::cost(problem.network, task, problem.values));
  const assessor::Context context{problem.network,       problem.values,   problem.chains,
                                  problem.timelines_now, problem.products, {},
                                  problem.closed};
  forecast_ = problem.assessor.forecast(context);
  for (std::uint32_t index = 0; index < count; ++index) {
    double cost = 0;
    for (const Subtask& link : chain(index).links) cost += of_tasks[link.task];
    costs_.push_back(rounded(cost));
    contextual_.push_back(problem.assessor.contextual(index, context));
    if (!contextual_.back()) utilities_[index] = rounded(problem.assessor.predicted(index, context));
  }
}

bool ChainTable::fixed(std::uint32_t index) const {
  const auto is_fixed = [this](const Subtask& link) { return problem_.network.tasks[link.task].fixed; };
  return request(index).fixed || std::ranges::any_of(chain(index).links, is_fixed);
}

std::span<const Link> ChainTable::links(std::uint32_t index) {
  std::vector<Link>& links = links_[index];
  if (links.empty()) {
    links = make_links(index);
    for (const Link& link : links)
      link_bytes_ += sizeof(Link) + link.footprint.impacts.capacity() * sizeof(temporal::timelines::Impact) +
                     link.footprint.constraints.capacity() * sizeof(temporal::timelines::Constraint);
  }
  return links;
}

std::vector<Link> ChainTable::make_links(std::uint32_t index) const {
  const Task& asked = request(index);
  std::vector<Link> out;
  for (const Subtask& subtask : chain(index).links) {
    const Task& task = problem_.network.tasks[subtask.task];
    Link& link = out.emplace_back();
    link.id = problem_.first_id + task_id(index, out.size() - 1);
    link.footprint = flattening::footprint(problem_.network, chain(index), out.size() - 1, problem_.values);
    link.shortest_gap = subtask.shortest_gap;
    link.longest_gap = subtask.longest_gap;
    // What comes from outside, as a view of Earth, does not end with the budget.
    const bool from_outside = task.fixed && task.commands.empty();
    const Time end = from_outside ? problem_.network.cycle.plan_end : problem_.until;
    const Time latest_end = std::min({task.closes, asked.closes, end});
    link.starts = {std::max({problem_.from, task.opens, asked.opens}),
                   plus(latest_end, -link.footprint.duration)};
    const bool first = out.size() == 1;
    const Task& timed = first && bounded(asked.preferred_start) ? asked : task;
    link.preferred_start = timed.preferred_start;
    if (timed.fixed && bounded(timed.preferred_start))
      link.starts = {std::max(link.starts.earliest, timed.preferred_start),
                     std::min(link.starts.latest, timed.preferred_start)};
  }
  return out;
}

RankVector ChainTable::predicted(std::uint32_t index, std::span<const std::uint32_t> planned) const {
  if (!contextual_[index]) return utilities_[index];
  const assessor::Context context{problem_.network,  problem_.values, problem_.chains, problem_.timelines_now,
                                  problem_.products, planned,         problem_.closed};
  return rounded(problem_.assessor.predicted(index, context));
}

RankVector ChainTable::forecast(std::uint32_t index) const {
  return contextual_[index] ? rounded(forecast_->predicted(index)) : utilities_[index];
}

void ChainTable::add_data(const Placed& placed, PlannedData& out) const {
  const Chain& links = chain(placed.chain);
  for (std::size_t index = 0; index < links.links.size(); ++index) {
    const Task& task = problem_.network.tasks[links.links[index].task];
    if (task.products.empty() && !task.downlinks) continue;
    const Time end = plus(placed.starts[index],
                          temporal::seconds(std::max(0.0, model::evaluate(task.duration, problem_.values))));
    if (task.downlinks) out.downlinks.push_back({links.links[index].task, placed.starts[index], end});
    for (const model::Product& product : task.products)
      out.products.push_back(search::predicted(request(placed.chain), task, product, end, problem_.values));
  }
}

model::DataProduct predicted(const Task& request, const Task& task, const model::Product& product, Time end,
                             const model::Values& values) {
  const double bytes = std::ceil(std::max(0.0, model::evaluate(product.bytes, values)));
  return {request.id + "/" + task.id + "/" + product.name, product.tier, static_cast<std::uint64_t>(bytes),
          end, product.utility};
}

PlannedData ChainTable::committed_data() const {
  if (problem_.standing) return *problem_.standing;
  PlannedData out;
  for (const Placed& placed : problem_.committed) add_data(placed, out);
  out.committed_products = out.products.size();
  out.committed_downlinks = out.downlinks.size();
  return out;
}

std::vector<std::uint32_t> by_start(std::span<const Placed> committed, std::span<const Placed> placed) {
  std::vector<std::pair<Time, std::uint32_t>> order;
  order.reserve(committed.size() + placed.size());
  for (const auto& chains : {committed, placed}) {
    for (const Placed& each : chains) order.emplace_back(each.starts.front(), each.chain);
  }
  std::ranges::sort(order);
  std::vector<std::uint32_t> out;
  out.reserve(order.size());
  for (const auto& [start, chain] : order) out.push_back(chain);
  return out;
}

}  // namespace roci::planner::utility_htn::search
