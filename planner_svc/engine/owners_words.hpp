// This file puts in the words of the mission what owners of external functions say against the objects of a
// goal that is out of reach.
#pragma once

#include <set>
#include <span>
#include <string>
#include <vector>

#include "planner_svc/engine/function_source.hpp"
#include "planner_svc/engine/request.hpp"

namespace roci::planner::engine {

/// What owners say against an object.
struct OwnersWords {
  std::string text;    ///< empty: nothing
  bool proved = true;  ///< false: they only found no value with the effort spent
};

/// Returns a sentence about one of the named objects, for which the owner of a function gave no value of that function
/// with any other object, or an empty one if there is no such object. E.g. "place-far (x=190 y=60): the rover cannot
/// stand there (steep) (says pathplan_svc, model 1)", or without words of the owner "place-far (x=190 y=60) is
/// unreachable (says pathplan_svc, traverse_time, model 1)". Where an owner only found none with the effort spent,
/// nothing is proved and the sentence says so: "no way to place-far (x=190 y=60) is known: pathplan_svc found none …".
OwnersWords words_against(const std::set<std::string>& named, const std::vector<Object>& objects,
                          std::span<const FunctionUse> uses);

}  // namespace roci::planner::engine
