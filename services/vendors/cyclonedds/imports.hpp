// This file replaces functions that a loaded library has imported by ours.
//
// It is the seam for Cyclone DDS, which has no transport that could be chained: its two relevant calls into the C
// library go through its table of imports. Opening the plug-in with RTLD_DEEPBIND would bind them to it as well, but
// then the plug-in and Cyclone DDS see another std::cerr than the program (which has a copy of its own, by copy
// relocation, while the library's stays unconstructed: the first line logged is a crash), and libfaketime and
// sanitizers no longer stand before them. The table touches nothing else.
#pragma once

#include <string_view>

namespace roci::services::vendors::cyclonedds {

/// Lets the library that `inside` points into call `replacement` instead of the imported `function` from now on.
/// Returns what it called so far, or null if the library imports no such function or its table cannot be written. No
/// thread may be in that library meanwhile.
void* replace_import(const void* inside, std::string_view function, void* replacement);

}  // namespace roci::services::vendors::cyclonedds
