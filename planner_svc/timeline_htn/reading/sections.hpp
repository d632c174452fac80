// Each section of a model is read from an entry into the vocabulary, in this order; the last ones refer to
// the first.
#pragma once

#include <map>
#include <string>
#include <utility>

#include "planner_svc/timeline_htn/model/check.hpp"
#include "planner_svc/timeline_htn/reading/vocabulary.hpp"

namespace roci::planner::timeline_htn::reading {

/// Tells where the parts of a model stand in its files: "file:line:column", by part, index and state.
using Places = std::map<std::tuple<model::Part, model::Index, model::Index>, std::string>;

void read_types(const mission::Entry& section, Vocabulary& vocabulary);
void read_objects(const mission::Entry& section, Vocabulary& vocabulary);
/// Reads the names and arguments of tables.
void declare_relations(const mission::Entry& section, Vocabulary& vocabulary);
void declare_numbers(const mission::Entry& section, Vocabulary& vocabulary);
/// Reads their rows; those of one table may stand in several files.
void read_relations(const mission::Entry& section, Vocabulary& vocabulary);
void read_numbers(const mission::Entry& section, Vocabulary& vocabulary);
/// Sorts the rows; called once all are there.
void finish_tables(Vocabulary& vocabulary);
/// Reads the names of components and of their states with parameters and kinds.
void declare_components(const mission::Entry& section, Vocabulary& vocabulary, Places& places);
/// Reads all else of them.
void define_components(const mission::Entry& section, Vocabulary& vocabulary);
void read_behaviours(const mission::Entry& section, Vocabulary& vocabulary, Places& places);
void read_problem(const mission::Entry& section, Vocabulary& vocabulary, Places& places);

}  // namespace roci::planner::timeline_htn::reading
