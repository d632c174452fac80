// These are the parts of the check, one for each file; each adds its faults.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <vector>

#include "planner_svc/utility_htn/checking/question.hpp"

namespace roci::planner::utility_htn::checking {

using Faults = std::vector<std::string>;

void check_blocks(const Question& question, Faults& out);
void check_times(const Question& question, Faults& out);
void check_commitments(const Question& question, Faults& out);
void check_conditions(const Question& question, Faults& out);
void check_ranges(const Question& question, Faults& out);
void check_budget(const Question& question, Faults& out);
void check_sessions(const Question& question, Faults& out);
void check_downlinks(const Question& question, Faults& out);
void check_subway_map(const Question& question, Faults& out);

/// Returns the requests of which no way to do them can come about, by the states that are reached now or by anything
/// that is planned or still asked for. Templates that are asked for are not known here,
/// so more may be returned than there are.
std::set<model::TaskIndex> out_of_reach(const Question& question);

/// Returns the value of the parameter of that name, as missions call it.
double parameter(const Question& question, const std::string& name, double otherwise);
/// Returns the sol in which that time lies.
std::int64_t sol_of(const Question& question, temporal::Time time);

/// Prints "task 'x' at 12 s".
std::string name(const Question& question, const Step& step);
std::string number(double value);

/// Returns whether indices can be followed: everything else is checked only then.
bool in_range(const Question& question, Faults& out);

/// Returns whether a value is within the bounds, to the last digits of a sum.
bool within(double value, double lowest, double highest);

}  // namespace roci::planner::utility_htn::checking
