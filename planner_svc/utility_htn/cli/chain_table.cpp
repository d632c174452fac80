#include "planner_svc/utility_htn/cli/chain_table.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "planner_svc/utility_htn/cli/words.hpp"
#include "planner_svc/utility_htn/model/describe.hpp"

namespace roci::planner::utility_htn::cli {

using flattening::Chain, flattening::Chains;
using model::Network, model::Subtask, model::Values;

ChainRow row_of(const Network& network, const Chain& chain, const Values& values) {
  const model::Task& task = network.tasks.at(chain.task);
  ChainRow out;
  out.batch = network.batches.empty() ? "" : network.batches.at(task.batch);
  out.name = chain.name;
  out.utility = flattening::utility(network, chain, values);
  out.cost = flattening::cost(network, chain, values);
  for (const Subtask& link : chain.links)
    out.duration_s += model::evaluate(network.tasks.at(link.task).duration, values) +
                      temporal::to_seconds(link.shortest_gap);
  return out;
}

std::string chain_table(const Network& network, const Chains& chains) {
  const Values values = model::priors(network);
  std::vector<ChainRow> rows{{"batch", "chain", {}, 0, 0}};
  for (const Chain& chain : chains.chains) rows.push_back(row_of(network, chain, values));
  std::size_t batch = 0, name = 0;
  for (const ChainRow& row : rows) {
    batch = std::max(batch, row.batch.size());
    name = std::max(name, row.name.size());
  }
  const std::string& budget = network.timelines.at(network.budget).name;
  std::string out = padded("batch", batch) + "  " + padded("chain", name) + "  " + padded(budget, 12) + "  " +
                    padded("seconds", 10) + "  utility\n";
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const ChainRow& row = rows[i];
    out += padded(row.batch, batch) + "  " + padded(row.name, name) + "  " + padded(number(row.cost), 12) +
           "  " + padded(number(row.duration_s), 10) + "  " + in_ranks(row.utility, network) + "\n";
  }
  std::map<model::TaskIndex, double> dearest;
  for (const Chain& chain : chains.chains) {
    double& most = dearest[chain.task];
    most = std::max(most, flattening::cost(network, chain, values));
  }
  double sum = 0;
  for (const auto& [task, cost] : dearest) sum += cost;
  out += std::to_string(chains.chains.size()) + " chains of " + std::to_string(dearest.size()) +
         " tasks; the dearest of each together take " + number(sum) + " of '" + budget +
         "', which begins at " + number(network.timelines.at(network.budget).initial) + "\n";
  return out;
}

std::string chain_json(const Network& network, const Chains& chains) {
  const Values values = model::priors(network);
  nlohmann::ordered_json out = {{"network", network.name},
                                {"version", network.version},
                                {"budget", network.timelines.at(network.budget).name},
                                {"ranks", network.ranks},
                                {"chains", nlohmann::ordered_json::array()}};
  for (const Chain& chain : chains.chains) {
    const ChainRow row = row_of(network, chain, values);
    std::vector<std::string> links, when;
    for (const Subtask& link : chain.links) links.push_back(network.tasks.at(link.task).id);
    for (const auto& constraint : chain.when) when.push_back(to_text(constraint, network));
    out["chains"].push_back({{"chain", row.name},
                             {"task", network.tasks.at(chain.task).id},
                             {"batch", row.batch},
                             {"utility", row.utility.scores()},
                             {"cost", row.cost},
                             {"duration_s", row.duration_s},
                             {"links", links},
                             {"when", when}});
  }
  return out.dump(2);
}

}  // namespace roci::planner::utility_htn::cli
