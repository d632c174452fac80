// The floors within services/, core/ and others: who may see whom, through any chain of includes.
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace roci::architecture {

/// Files that reach a floor above their own through any chain of the project's includes, each with the chain;
/// files of a house that has floors but stand on none.
std::vector<std::string> upward_includes(const std::vector<SourceFile>& files);

/// Files of exec_svc that reach core/pddl, through any chain, from elsewhere than the two folders that turn a mission's
/// PDDL into plain values and back; goals, reactor, executive, journal and all others fly missions without PDDL, too.
std::vector<std::string> pddl_outside_its_door(const std::vector<SourceFile>& files);

}  // namespace roci::architecture
