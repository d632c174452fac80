#include "sim_svc/components/argument_slots.hpp"

namespace roci::sim::components {

std::string fill_slots(std::string word, const std::map<std::string, std::string>& arguments) {
  for (const auto& [name, value] : arguments) {
    const std::string slot = "{" + name + "}";
    for (auto at = word.find(slot); at != std::string::npos; at = word.find(slot, at + value.size())) {
      word.replace(at, slot.size(), value);
    }
  }
  return word;
}

void check_slots(const mission::Entry& entry, std::string word, const std::string& command,
                 const std::vector<std::string>& arguments) {
  for (const std::string& argument : arguments) {
    const auto at = word.find("{" + argument + "}");
    if (at != std::string::npos) word.erase(at, argument.size() + 2);
  }
  if (word.find_first_of("{}") != std::string::npos) {
    entry.fail("'" + word + "' names no argument of '" + command + "'; add it to its arguments");
  }
}

}  // namespace roci::sim::components
