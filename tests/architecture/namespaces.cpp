#include "tests/architecture/namespaces.hpp"

#include <algorithm>
#include <map>
#include <regex>
#include <set>

namespace roci::architecture {
namespace {

const std::map<std::string, std::string> kNamespaceOf = {{"core", "roci"},
                                                         {"services", "roci::services"},
                                                         {"planner_svc", "roci::planner"},
                                                         {"exec_svc", "roci::exec"},
                                                         {"pathplan_svc", "roci::pathplan"},
                                                         {"dedicated_svc", "roci::dedicated"},
                                                         {"arm_svc", "roci::arm"},
                                                         {"science_svc", "roci::science"},
                                                         {"sim_svc", "roci::sim"},
                                                         {"ground_console", "roci::console"},
                                                         {"rehearsal", "roci::rehearsal"}};

struct Block {
  std::string name;
  bool declares_only = true;  // nothing but classes of others
};

// The named namespaces that stand in no other. The formatter writes a comment at the end of all but the
// shortest.
std::vector<Block> top_level(const SourceFile& file) {
  static const std::regex opening(R"(^namespace ([\w:]* ?)\{.*)");
  static const std::regex declaration(R"(\s*((class|struct) \w+;|\}?)\s*(//.*)?)");
  std::vector<Block> found;
  std::vector<Block> open;
  for (const std::string& line : file.lines) {
    std::smatch match;
    if (std::regex_match(line, match, opening)) {
      std::string name = match[1];
      if (name.ends_with(' ')) name.pop_back();
      open.push_back({name});
    } else if (!open.empty() &&
               (line.starts_with("}  // namespace") || (line == "}" && open.back().declares_only))) {
      const Block ended = open.back();
      open.pop_back();
      if (open.empty() && !ended.name.empty()) found.push_back(ended);
    } else if (!std::regex_match(line, declaration)) {
      for (Block& block : open) block.declares_only = false;
    }
  }
  if (!open.empty() && !open.front().name.empty()) found.push_back(open.front());  // its end bears no comment
  return found;
}

}  // namespace

std::string namespace_of(const std::string& path) {
  const std::string folder = path.substr(0, path.find_last_of('/'));
  const auto top = kNamespaceOf.find(folder.substr(0, folder.find('/')));
  if (top == kNamespaceOf.end()) return "";
  std::string name = top->second;
  for (std::size_t slash = folder.find('/'); slash != std::string::npos;) {
    const std::size_t next = folder.find('/', slash + 1);
    name += "::" + folder.substr(slash + 1, next == std::string::npos ? next : next - slash - 1);
    slash = next;
  }
  return name;
}

std::vector<std::string> foreign_namespaces(const std::vector<SourceFile>& files) {
  std::set<std::string> of_folders;
  for (const SourceFile& file : files) of_folders.insert(namespace_of(file.path));
  std::vector<std::string> breaches;
  for (const SourceFile& file : files) {
    const std::string wanted = namespace_of(file.path);
    if (wanted.empty()) continue;
    for (const Block& block : top_level(file)) {
      const bool own = block.name == wanted;
      const bool within = block.name.starts_with(wanted + "::") && !of_folders.contains(block.name);
      if (own || within || block.declares_only) continue;
      breaches.push_back(file.path + ": opens namespace " + block.name + "; its folder's is " + wanted);
    }
  }
  return breaches;
}

}  // namespace roci::architecture
