// The floors of the planner's engine: who may see whom, through any chain of includes.
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace roci::architecture {

/// Returns what breaks the planner's rules among `files`, one line each, with the chain of includes that does
/// it:
///  - a folder of planner_svc/temporal_pddl reaches no folder of a higher floor;
///  - folders that work on the ground task reach neither core/pddl nor the grounder;
///  - heuristics and dead-end detectors do not reach each other;
///  - the validator reaches nothing of the engine, and only the checker beside it reaches the validator.
/// Includes are followed through every project file among `files`; one that is not among them counts as
/// itself.
std::vector<std::string> broken_planner_rules(const std::vector<SourceFile>& files);

/// Returns the files that know an engine though they need not: nothing outside planner_svc/F, but
/// planner_svc/engines.cpp, includes a header of planner_svc/F, unless F is planner_svc/engine.
std::vector<std::string> broken_seam_rules(const std::vector<SourceFile>& files);

}  // namespace roci::architecture
