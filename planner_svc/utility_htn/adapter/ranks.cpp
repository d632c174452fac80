// What earns utility at each rank of a network (R113).
#include <algorithm>
#include <string>

#include "planner_svc/utility_htn/adapter/outlook.hpp"

namespace roci::planner::utility_htn::adapter {
namespace {

/// So many are named, the others counted.
constexpr std::size_t kNamed = 4;

void add_once(std::vector<std::string>& names, const std::string& name) {
  if (std::ranges::find(names, name) == names.end()) names.push_back(name);
}

std::string listed(const std::vector<std::string>& names) {
  std::string out;
  for (std::size_t i = 0; i < std::min(names.size(), kNamed); ++i) out += (i == 0 ? "" : ", ") + names[i];
  if (names.size() > kNamed) out += " and " + std::to_string(names.size() - kNamed) + " more";
  return out;
}

bool may_count(const model::Amount& amount) { return amount.constant != 0 || amount.parameter.has_value(); }

}  // namespace

std::vector<engine::UtilityRank> ranks_of(const model::Network& network) {
  std::vector<std::vector<std::string>> tasks(network.ranks.size());
  std::vector<std::vector<std::string>> data(network.ranks.size());
  for (const model::Task& task : network.tasks) {
    for (std::size_t rank = 0; rank < std::min(task.utility.size(), tasks.size()); ++rank)
      if (may_count(task.utility[rank])) add_once(tasks[rank], task.name.empty() ? task.id : task.name);
    for (const model::Product& product : task.products)
      for (std::size_t rank = 0; rank < data.size(); ++rank)
        if (product.utility[rank] != 0) add_once(data[rank], product.name);
  }
  std::vector<engine::UtilityRank> out;
  for (std::size_t rank = 0; rank < network.ranks.size(); ++rank) {
    std::string meaning;
    const auto add = [&](const std::string& part) { meaning += (meaning.empty() ? "" : "; ") + part; };
    if (!network.subway.sites.empty() && network.subway.rank == rank)
      add("a sample where the science subway map leads");
    if (!tasks[rank].empty()) add("tasks: " + listed(tasks[rank]));
    if (!data[rank].empty()) add("data on Earth: " + listed(data[rank]));
    out.push_back({network.ranks[rank], meaning.empty() ? "nothing in this network" : meaning});
  }
  return out;
}

}  // namespace roci::planner::utility_htn::adapter
