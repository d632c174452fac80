// Headers say what they offer: each type and each function template has a comment of its own.
#pragma once

#include <string>
#include <vector>

#include "tests/architecture/source_tree.hpp"

namespace roci::architecture {

/// Returns one line for each type and each free function template that a header defines at the top level of a namespace
/// without a `///` comment directly above it; for a definition on one line a `///<` behind it will do. Exempt are
/// declarations of types, specialisations, what stands in an unnamed namespace or in one called detail, deduction
/// guides, and the fields() of an archive, which the head of their file describes.
std::vector<std::string> undocumented(const std::vector<SourceFile>& files);

}  // namespace roci::architecture
