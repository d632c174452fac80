// What owners of external functions say against the objects of a goal that is out of reach,
// in the words of the mission.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/pddl/ast.hpp"
#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/engine/owners_words.hpp"
#include "planner_svc/engine/request.hpp"

namespace roci::planner::temporal_pddl::adapter {

/// engine::words_against() the objects that the facts name, or that a fact of the problem joins with one of these.
engine::OwnersWords words_against(const std::vector<std::string>& facts, const pddl::Problem& problem,
                                  const std::vector<engine::Object>& objects,
                                  std::span<const engine::FunctionUse> uses);

}  // namespace roci::planner::temporal_pddl::adapter
