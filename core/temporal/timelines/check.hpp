// These checks say what a kind of timeline permits (MEXEC, section IV.A.2, R71, R72), as plain sentences
// about what breaks it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "core/temporal/timelines/definition.hpp"

namespace roci::temporal::timelines {

/// Returns every fault of a definition, each as one sentence that names the timeline; none if it can be used. A range
/// must hold the initial value; an atomic timeline starts at 0;
/// a state timeline has 1 to 64 states and starts in one of them.
std::vector<std::string> check(const Definition& definition);

/// Returns every fault of what a task does and asks, each as one sentence that names the timeline. Permitted are
/// - on an atomic timeline: a delta of 1 during the task;
/// - on a state timeline: assignments of one of its states, at the start or at the end, and constraints on states;
/// - on a claimable one: deltas during the task;
/// - on a cumulative one: deltas, and assignments at the start or at the end;
/// - on a cumulative-rate one: moreover rates.
/// An assignment `during` a task says nothing about what comes after it, and is permitted nowhere.
/// The definitions are without fault.
std::vector<std::string> check(std::span<const Definition> definitions, const Footprint& footprint);

/// Returns whether check() finds nothing, without making sentences.
bool permitted(std::span<const Definition> definitions, const Footprint& footprint);

/// Throws std::invalid_argument with all sentences, if there are any.
void refuse_faults(const Definition& definition);
void refuse_faults(std::span<const Definition> definitions, const Footprint& footprint);

/// Returns "cumulative rate" and so on.
const char* to_string(Kind kind);

}  // namespace roci::temporal::timelines
