// This file loads a checked model from files or texts: everybody who wants to plan with one calls it (R134).
// docs/timeline-format.md is the schema.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/mission/findings.hpp"
#include "planner_svc/timeline_htn/model/model.hpp"

namespace roci::planner::timeline_htn::reading {

/// Numbers the version of the form, the newest that is read (docs/formats.md).
inline constexpr int kFormat = 1;

/// Holds a part of a model that came otherwise than as a file; `name` stands for the file in what is said of
/// places.
struct Text {
  std::string name;
  std::string content;
};

/// Reads domain, behaviours and problem, which may stand in one file or in several that belong together, with what they
/// include. All faults are noted, each with file, line and remedy. Returns nothing where one is an error: a model is
/// taken whole or not at all.
std::optional<model::Model> load_model(const std::vector<std::filesystem::path>& files,
                                       mission::Findings& findings);
/// Does the same, and throws mission::FileError with the errors, one in each line.
model::Model load_model(const std::vector<std::filesystem::path>& files);

/// Says whether the problem of a text is all there is to it, or is to be completed by a request before it is checked.
enum class Problem { whole, of_a_request };

/// Reads texts; one may be a model of several files (mission::model_text), which include each other.
std::optional<model::Model> parse_model(const std::vector<Text>& texts, mission::Findings& findings,
                                        Problem problem = Problem::whole);

/// Joins the errors to one text, one in each line, with place and remedy.
std::string errors_of(const mission::Findings& findings);

}  // namespace roci::planner::timeline_htn::reading
