// This file reads the methods of a dedicated executive from the section `dedicated` of its mission file.
#pragma once

#include "core/mission/entry.hpp"
#include "dedicated_svc/methods/method.hpp"

namespace roci::dedicated::methods {

/// Reads and checks the section. Throws mission::FileError with place and remedy: a word that nobody knows, a call
/// without a kind or with two, a name twice, `{…}` of an argument or call that is not there (or comes later), a repair
/// that goes on with no call of its method, or ends it before a result is there, a limit that is no positive time, more
/// than the bounds below.
Methods read_methods(const mission::Entry& section);

inline constexpr std::size_t kMethods = 100;
inline constexpr std::size_t kCalls = 100;  ///< of one method, with its repairs

}  // namespace roci::dedicated::methods
