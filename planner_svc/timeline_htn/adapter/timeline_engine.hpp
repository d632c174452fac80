// This is the engine behind planner_svc's seam: a request comes in, a plan of hierarchical flexible timelines
// goes out.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "planner_svc/engine/answering_engine.hpp"
#include "planner_svc/engine/table.hpp"
#include "planner_svc/timeline_htn/search/resolvers.hpp"

namespace roci::planner::timeline_htn::adapter {

/// Says which searches run where a request names none, and on how many threads:
/// the plan is the same for any number of these (R132).
struct Settings {
  std::vector<search::Resolver> resolvers{search::Resolver{}};  ///< at least one
  std::size_t threads = 1;
};

/// Plans requests whose `model` is domain and behaviours, with or without a problem; `problem_text` may hold more
/// of the model. What the request says of states, objects and goals counts.
class TimelineEngine final : public engine::AnsweringEngine {
 public:
  explicit TimelineEngine(Settings settings = {}) : settings_(std::move(settings)) {}
  engine::Answer answer(const engine::Request& request, const engine::Limits& limits,
                        engine::FunctionSource& functions) override;

 private:
  Settings settings_;
};

/// Returns whom a model asks for its tables (engine::TableEntry::asked_functions).
std::vector<engine::AskedFunction> asked_functions(const std::string& model, const std::string& name);

/// Notes what is wrong with a model and returns the timelines of its states (engine::TableEntry::check_model).
std::vector<std::string> check_model(const std::string& model, const std::string& name,
                                     mission::Findings& findings);

}  // namespace roci::planner::timeline_htn::adapter
