#include "planner_svc/utility_htn/adapter/resolvers.hpp"

#include <algorithm>
#include <map>
#include <stdexcept>

#include "planner_svc/utility_htn/search/scheduler.hpp"

namespace roci::planner::utility_htn::adapter {

namespace {

const std::map<std::string, cycle::Search>& searches() {
  static const std::map<std::string, cycle::Search> named{{"anytime", cycle::Search::anytime},
                                                          {"robust", cycle::Search::robust}};
  return named;
}

void take(std::string& taken, const std::string& name, const std::string& kind) {
  if (!taken.empty())
    throw std::invalid_argument("'" + taken + "' and '" + name + "' are two " + kind + "; name one of them");
  taken = name;
}

}  // namespace

std::vector<std::string> resolver_names() {
  std::vector<std::string> out;
  for (const auto& [name, search] : searches()) out.push_back(name);
  for (const auto& name : search::scheduler_names()) out.emplace_back(name);
  return out;
}

Resolvers read_resolvers(const std::vector<std::string>& names) {
  Resolvers out;
  std::string way, scheduler;
  for (const std::string& name : names) {
    if (const auto search = searches().find(name); search != searches().end()) {
      take(way, name, "ways to search");
      out.search = search->second;
    } else {
      take(scheduler, name, "schedulers");
      out.scheduler = name;
    }
  }
  search::make_scheduler(out.scheduler);  // it knows the names
  return out;
}

}  // namespace roci::planner::utility_htn::adapter
