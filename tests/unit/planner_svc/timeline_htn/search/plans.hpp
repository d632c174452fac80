// What tests of the search share: models from texts, and their plans.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <optional>
#include <string>
#include <vector>

#include "planner_svc/timeline_htn/extraction/plan_of.hpp"
#include "planner_svc/timeline_htn/reading/load.hpp"
#include "planner_svc/timeline_htn/search/search.hpp"

namespace roci::planner::timeline_htn {

inline model::Model model_of(const std::vector<std::string>& texts) {
  mission::Findings findings;
  std::vector<reading::Text> named;
  for (const std::string& text : texts) named.push_back({"m.yaml", text});
  const auto model = reading::parse_model(named, findings);
  EXPECT_TRUE(model) << reading::errors_of(findings);
  return model.value_or(model::Model{});
}

inline std::string text_of_file(const std::string& file) {
  std::ifstream in(std::string(ROCI_SOURCE_DIR "/") + file);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Replaces the first `from` in the text, which must hold it.
inline std::string with(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return at == std::string::npos ? text : text.replace(at, from.size(), to);
}

/// Is an outcome with the plan, if there is one.
struct Planned {
  search::Outcome outcome;
  std::optional<temporal::FlexiblePlan> plan;
  std::string reason;
  search::Count count;

  std::vector<std::string> names() const {
    std::vector<std::string> out;
    if (plan)
      for (const auto& activity : plan->activities) out.push_back(activity.name);
    return out;
  }
  const temporal::PlanActivity* find(const std::string& name) const {
    for (const auto& activity : plan->activities)
      if (activity.name == name) return &activity;
    return nullptr;
  }
};

inline Planned planned(const model::Model& model, const search::Resolver& resolver = {},
                       std::uint64_t work = 300'000) {
  search::Search search(model, resolver);
  Planned out{search.run(work, 0, [] { return false; }), std::nullopt, search.reason(), search.count()};
  if (out.outcome == search::Outcome::solved) {
    out.plan = extraction::plan_of(search, {"plan", "a", temporal::Time{0}});
    const auto faults = temporal::check(*out.plan);
    EXPECT_TRUE(faults.empty()) << faults.front();
  }
  return out;
}

}  // namespace roci::planner::timeline_htn
