// These limits bound how far what a console remembers may grow by what comes from the wire (docs/resilience.md,
// "What is bounded").
#pragma once

#include <cstddef>

namespace roci::console::lib {

/// Goals, timelines, products, hazards, decisions and orders, of each kind: as many as an executive keeps. New ones
/// beyond it are not shown; MissionView::unseen() counts them.
inline constexpr std::size_t kEntries = 10'000;
/// Steps of plans: those of the largest plan that the wire carries.
inline constexpr std::size_t kSteps = 100'000;
/// Stages of one order; each is said once, and once more to who joins late.
inline constexpr std::size_t kStages = 64;
/// Executives, each with its plan, and robots with what their planners expect.
inline constexpr std::size_t kExecutives = 64;
/// Services, and members of pairs.
inline constexpr std::size_t kServices = 1'024;

}  // namespace roci::console::lib
