#include "planner_svc/engine/table.hpp"

namespace roci::planner::engine {

std::string names_of_answering(const Table& table) {
  std::string names;
  for (const auto& [name, entry] : table)
    if (std::holds_alternative<MakeAnswering>(entry.make)) names += (names.empty() ? "" : ", ") + name;
  return names.empty() ? "none" : names;
}

const MakeStepped* stepped_named(const Table& table, const std::string& name) {
  const auto found = table.find(name);
  return found == table.end() ? nullptr : std::get_if<MakeStepped>(&found->second.make);
}

}  // namespace roci::planner::engine
