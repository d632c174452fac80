// A trace map is applied to lines here: OLD gets the new names, and NEW loses what was added.
#pragma once

#include <cstddef>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "exec_svc/trace/recorded_trace.hpp"
#include "exec_svc/trace/trace_map.hpp"

namespace roci::exec::trace {

/// Counts how often each rule of a map was of use.
using Uses = std::map<Place, std::size_t>;

/// Returns whether the text is one word: a row of letters, digits, `_`, `-` and `.` that does not end with
/// `-` or `.`; bytes beyond ASCII are letters.
bool is_word(std::string_view text);

/// Returns the text of an OLD line as NEW calls it. All words are renamed at once, so that two names may
/// change places; then the rewrites go over the text, in the order of the file.
std::string renamed(const std::string& text, const TraceMap& map, Uses& uses);

/// Returns these lines without those, and without those parts, that the map says were added.
std::vector<Line> without_additions(std::vector<Line> lines, const TraceMap& map, Uses& uses);

}  // namespace roci::exec::trace
