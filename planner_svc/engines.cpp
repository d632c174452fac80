#include "planner_svc/engines.hpp"

#include <memory>

#include "planner_svc/temporal_pddl/adapter/pddl_engine.hpp"
#include "planner_svc/temporal_pddl/checker/pddl_checker.hpp"

namespace roci::planner {

const engine::Table& engines() {
  static const engine::Table table{
      {"temporal_pddl",
       {engine::MakeAnswering([] { return std::make_unique<temporal_pddl::adapter::PddlEngine>(); }),
        [] { return std::make_unique<temporal_pddl::checker::PddlChecker>(); }}},
  };
  return table;
}

}  // namespace roci::planner
