// Plans to check: those that the search makes of a model.
#pragma once

#include <filesystem>
#include <stdexcept>
#include <string>

#include "planner_svc/timeline_htn/extraction/plan_of.hpp"
#include "planner_svc/timeline_htn/reading/load.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn::checking {

inline temporal::FlexiblePlan plan_for(const model::Model& model) {
  search::Search search(model, {});
  if (search.run(1'000'000, 0, [] { return false; }) != search::Outcome::solved)
    throw std::runtime_error("no plan: " + search.reason());
  return extraction::plan_of(search, {"p1", "a", temporal::Time{0}});
}

inline model::Model load(const std::string& file) {
  return reading::load_model({std::filesystem::path(ROCI_SOURCE_DIR) / file});
}

inline model::Model parse(const std::string& text) {
  mission::Findings findings;
  auto model = reading::parse_model({{"m.yaml", text}}, findings);
  if (!model) throw std::runtime_error(reading::errors_of(findings));
  return *model;
}

}  // namespace roci::planner::timeline_htn::checking
