// These bounds say how large a model of timelines may be, so that it fits into memory together with what is searched
// on it. A larger one is refused whole, and counted before anything is made of it.
#pragma once

#include <cstddef>

#include "core/temporal/duration.hpp"

namespace roci::planner::timeline_htn::model {

inline constexpr std::size_t kMostBytes = 8U << 20U;  ///< of all texts of a model together
inline constexpr std::size_t kMostTexts = 64;         ///< files of a model, or texts of a call
inline constexpr std::size_t kMostTypes = 64;
inline constexpr std::size_t kMostObjects = 10'000;
inline constexpr std::size_t kMostTables = 64;         ///< relations, and likewise numbers
inline constexpr std::size_t kMostRows = 200'000;      ///< of all relations and numbers together
inline constexpr std::size_t kMostAsked = 20'000;      ///< numbers of one table that a service is asked for
inline constexpr std::size_t kMostComponents = 64;     ///< a set of them is one word of 64 bits
inline constexpr std::size_t kMostStates = 64;         ///< of one component
inline constexpr std::size_t kMostTransitions = 1000;  ///< of one component
inline constexpr std::size_t kMostParameters = 8;      ///< of a state, a relation or a number
inline constexpr std::size_t kMostVariables = 16;      ///< of a behaviour or a transition
inline constexpr std::size_t kMostBehaviours = 1000;
inline constexpr std::size_t kMostInList =
    64;  ///< of one state or behaviour: tests, needs, subgoals, constraints, …
inline constexpr std::size_t kMostGoals = 1000;
inline constexpr std::size_t kMostPredicted = 1000;     ///< values of one component
inline constexpr std::size_t kLongestExpression = 100;  ///< numbers, tables and operators in it
inline constexpr std::size_t kLongestText = 1000;  ///< bytes of a name or of a line of the small languages
inline constexpr temporal::Duration kLongestDuration = temporal::seconds(1e9);  ///< 31 years

}  // namespace roci::planner::timeline_htn::model
