// This file reads one task of a network file.
#pragma once

#include "planner_svc/utility_htn/reading/expansion.hpp"
#include "planner_svc/utility_htn/reading/names.hpp"

namespace roci::planner::utility_htn::reading {

/// Reads all of a task but its id. Faults in its lists are noted one by one where findings are collected.
model::Task read_task(const std::string& id, const Source& source, const Vocabulary& vocabulary,
                      Expansion& expansion, bool is_template);

}  // namespace roci::planner::utility_htn::reading
