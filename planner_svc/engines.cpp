#include "planner_svc/engines.hpp"

#include <memory>

#include "planner_svc/temporal_pddl/adapter/pddl_engine.hpp"
#include "planner_svc/temporal_pddl/checker/pddl_checker.hpp"
#include "planner_svc/timeline_htn/adapter/timeline_engine.hpp"
#include "planner_svc/timeline_htn/adapter/timeline_resolver.hpp"
#include "planner_svc/timeline_htn/checking/timeline_checker.hpp"
#include "planner_svc/utility_htn/adapter/resolvers.hpp"
#include "planner_svc/utility_htn/adapter/utility_engine.hpp"
#include "planner_svc/utility_htn/checking/utility_checker.hpp"
#include "planner_svc/utility_htn/reading/load.hpp"

namespace roci::planner {

const engine::Table& engines() {
  static const engine::Table table{
      {"temporal_pddl",
       {engine::MakeAnswering([] { return std::make_unique<temporal_pddl::adapter::PddlEngine>(); }),
        [] { return std::make_unique<temporal_pddl::checker::PddlChecker>(); }}},
      {"timeline_htn",
       {engine::MakeAnswering([] { return std::make_unique<timeline_htn::adapter::TimelineEngine>(); }),
        [] { return std::make_unique<timeline_htn::checking::TimelineChecker>(); },
        [](const engine::Setup&) { return std::make_unique<timeline_htn::adapter::TimelineResolver>(); },
        timeline_htn::search::resolver_names(),
        {},
        timeline_htn::adapter::asked_functions,
        timeline_htn::adapter::check_model}},
      {"utility_htn",
       {engine::MakeStepped([](const engine::Setup& setup) {
          return std::make_unique<utility_htn::adapter::UtilityEngine>(
              setup, utility_htn::reading::load_network(setup.model_file));
        }),
        [] { return std::make_unique<utility_htn::checking::UtilityChecker>(); },
        {},
        utility_htn::adapter::resolver_names(),
        [](const auto& names) { utility_htn::adapter::read_resolvers(names); }}},
  };
  return table;
}

}  // namespace roci::planner
