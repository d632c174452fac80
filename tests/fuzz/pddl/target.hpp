// What fuzzing demands of core/pddl and the validator for any input: a result or a ParseError, in bounded
// time.
#pragma once

#include <string_view>

namespace roci::fuzz {

// The text as a domain, a problem, a plan and a table of function values; what parses is checked, printed,
// parsed again and compared; what checks clean is validated with a plan. Throws whatever is not a ParseError:
// a fault.
void run_all(std::string_view text);

}  // namespace roci::fuzz
