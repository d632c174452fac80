#include <algorithm>
#include <iterator>

#include "tests/architecture/documentation.hpp"
#include "tests/architecture/floors.hpp"
#include "tests/architecture/namespaces.hpp"
#include "tests/architecture/planner_rules.hpp"
#include "tests/architecture/source_tree.hpp"

namespace roci::architecture {
namespace {

constexpr std::size_t kLongestFile = 600;
constexpr std::ptrdiff_t kWidestComment = 120;
const std::vector<std::string> kProcesses = {"planner_svc", "exec_svc",    "pathplan_svc", "dedicated_svc",
                                             "arm_svc",     "science_svc", "sim_svc",      "ground_console"};

bool any_prefix(const std::string& text, const std::vector<std::string>& prefixes) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const std::string& prefix) { return text.starts_with(prefix); });
}

std::string folder_of(const std::string& path) { return path.substr(0, path.find('/')); }

bool is_process(const std::string& folder) {
  return std::find(kProcesses.begin(), kProcesses.end(), folder) != kProcesses.end();
}

// The door of a service, where wire types are translated.
bool is_door(const SourceFile& file) {
  if (file.under("ground_console")) return true;
  const std::string name = file.name();
  const std::string stem = name.substr(0, name.find_last_of('.'));
  return stem == "main" || stem.ends_with("_service");
}

using Complaints = std::vector<std::string>;

void check_floors(const SourceFile& file, Complaints& out) {
  const std::string here = folder_of(file.path);
  for (const std::string& include : file.includes) {
    const std::string there = folder_of(include);
    const auto complain = [&](const std::string& why) {
      out.push_back(file.path + ": includes " + include + "; " + why);
    };
    if (here == "core" && (there == "services" || there == "roci_idl" || is_process(there))) {
      complain("core/ knows no process, no DDS");
    }
    if (here == "services" && is_process(there)) complain("services/ knows no process");
    if (is_process(here) && is_process(there) && here != there)
      complain("no process includes another; talk over idl/");
    if (is_process(here) && (there == "services" || there == "roci_idl") && !is_door(file)) {
      complain("only *_service and main see services/ and idl/; translate at the door");
    }
  }
}

void check_vendors(const SourceFile& file, Complaints& out) {
  static const std::vector<std::string> vendor_headers = {"fastdds/", "fastrtps/", "dds/", "ddsc/"};
  if (file.under("services/vendors")) return;
  for (const std::string& include : file.includes) {
    if (any_prefix(include, vendor_headers)) {
      out.push_back(file.path + ": includes " + include +
                    "; vendor headers belong to services/vendors/ alone");
    }
  }
}

// Who may see a library: nobody else needs to link it.
void check_libraries(const SourceFile& file, Complaints& out) {
  struct Home {
    std::string header;
    std::vector<std::string> folders;
  };
  static const std::vector<Home> homes = {
      {"sqlite3", {"exec_svc"}},
      {"openssl/", {"exec_svc", "services/certificate", "services/security"}},
      {"yaml-cpp/", {"core/mission"}},
      {"ompl/", {"pathplan_svc", "arm_svc"}},
      {"Cbc", {"planner_svc/utility_htn/downlink"}},
      {"Cgl", {"planner_svc/utility_htn/downlink"}},
      {"Osi", {"planner_svc/utility_htn/downlink"}},
      {"Coin", {"planner_svc/utility_htn/downlink"}},
      {"fcl/", {"arm_svc"}},
      {"urdf_", {"core/kinematics"}},
      {"tinyxml2", {"core/kinematics"}},
      {"gdal", {"core/terrain"}},
      {"ogr_", {"core/terrain"}},
      {"cpl_", {"core/terrain"}},
      {"png.h", {"ground_console"}},
      {"spdlog/", {"services/log"}}};
  for (const std::string& include : file.includes) {
    for (const Home& home : homes) {
      const auto at_home = [&](const std::string& folder) { return file.under(folder); };
      if (!include.starts_with(home.header) || std::ranges::any_of(home.folders, at_home)) continue;
      out.push_back(file.path + ": includes " + include + "; that library is linked by " +
                    home.folders.front() + " alone");
    }
  }
}

// The checkers of the engines that plan by hierarchies share the model with the search, and nothing that computes.
void check_independent_checker(const SourceFile& file, Complaints& out) {
  for (const std::string engine : {"planner_svc/utility_htn/", "planner_svc/timeline_htn/"}) {
    if (!file.under(engine + "checking")) continue;
    for (const std::string& include : file.includes) {
      const bool allowed =
          !include.starts_with(engine) ||
          any_prefix(include, {engine + "model/", engine + "reading/", engine + "checking/"});
      const bool computes = include.starts_with("core/temporal/timelines/") &&
                            include != "core/temporal/timelines/definition.hpp";
      if (!allowed || computes) {
        out.push_back(file.path + ": includes " + include +
                      "; the checker sees the model and how it is read alone");
      }
    }
  }
}

// The simulator must not be right by construction.
void check_simulator(const SourceFile& file, Complaints& out) {
  if (!file.under("sim_svc")) return;
  for (const std::string& include : file.includes) {
    if (include.starts_with("pathplan_svc/") || include.starts_with("arm_svc/")) {
      out.push_back(file.path + ": includes " + include + "; the simulator integrates physics of its own");
    }
  }
}

void check_clock(const SourceFile& file, Complaints& out) {
  if (file.under("services/clock") || file.under("services/vendors")) return;
  for (const std::string& line : file.lines) {
    if (line.find("_clock::now") != std::string::npos) {
      out.push_back(file.path + ": asks the system for the time; nothing but services/clock does");
    }
  }
}

// Who renames a file must sync its folder, or a loss of power brings the old one back.
void check_renames(const SourceFile& file, Complaints& out) {
  if (file.under("core/durable")) return;
  for (const std::string& line : file.lines) {
    const auto call = line.find("rename(");
    const bool of_paths = call != std::string::npos && ((call >= 2 && line.compare(call - 2, 2, "::") == 0) ||
                                                        line.find("c_str()", call) != std::string::npos);
    if (of_paths || line.find("renameat") != std::string::npos)
      out.push_back(file.path + ": renames a file; core/durable does, and syncs its folder");
  }
}

void check_size_and_names(const SourceFile& file, Complaints& out) {
  if (file.lines.size() > kLongestFile) {
    out.push_back(file.path + ": " + std::to_string(file.lines.size()) + " lines; no file is longer than " +
                  std::to_string(kLongestFile));
  }
  for (const char* name : {"/utils/", "/util/", "/common/", "/misc/", "/helpers/"}) {
    if (("/" + file.path).find(name) != std::string::npos)
      out.push_back(file.path + ": a shared thing has a name");
  }
  for (const std::string& line : file.lines) {
    if (file.name().ends_with(".hpp") && line.starts_with("using namespace")) {
      out.push_back(file.path + ": 'using namespace' in a header");
    }
  }
}

// The formatter leaves comments as they are.
void check_width_of_comments(const SourceFile& file, Complaints& out) {
  const auto is_comment = [](const std::string& line) {
    const auto text = line.find_first_not_of(' ');
    return text != std::string::npos && line.compare(text, 2, "//") == 0;
  };
  const auto begins_character = [](char byte) { return (byte & 0xC0) != 0x80; };  // of UTF-8
  for (const std::string& line : file.lines) {
    if (!is_comment(line) || std::ranges::count_if(line, begins_character) <= kWidestComment) continue;
    out.push_back(file.path + ": \"" + line + "\" is wider than " + std::to_string(kWidestComment) +
                  " columns; wrap the comment");
  }
}

// Where the formatter had to break a line for the comment behind it, the comment belongs above.
void check_torn_comments(const SourceFile& file, Complaints& out) {
  for (const std::string& line : file.lines) {
    const auto text = line.find_first_not_of(' ');
    const bool continues = text != std::string::npos && text >= 6;
    const bool after_body = text != std::string::npos && line.compare(text, 1, "}") == 0;
    if ((continues || after_body) && line.find("///<") != std::string::npos) {
      out.push_back(file.path + ": \"" + line.substr(text) +
                    "\" stands torn; write the comment above the declaration");
    }
  }
}

// The partitions of an endpoint follow from its topic's scope and its service's robot, in one place.
void check_partitions(const SourceFile& file, Complaints& out) {
  if (file.under("services/vendors") || file.path.starts_with("services/transport/scope.")) return;
  if (file.path == "services/transport/transport.hpp" || file.path == "services/node/endpoints.cpp") return;
  if (file.path == "services/security/documents.cpp") return;  // permissions name those that follow
  for (const std::string& line : file.lines) {
    for (const char* sign : {"\"roci.inner", "\"roci.team", "partitions_of(", ".partitions", "PartitionQos",
                             "dds_qset_partition"}) {
      if (line.find(sign) == std::string::npos) continue;
      out.push_back(file.path + ": names a DDS partition (" + sign +
                    "); they follow from the topic table and the service's robot");
    }
  }
}

void check_missions(const SourceFile& file, Complaints& out) {
  for (const std::string& line : file.lines) {
    for (const char* mission : {"\"planetary\"", "\"orbital\"", "\"europa\"", "\"faster\""}) {
      if (line.find(mission) != std::string::npos)
        out.push_back(file.path + ": names the mission " + mission + "; missions are data");
    }
  }
}

}  // namespace

std::vector<std::string> broken_rules(const std::vector<SourceFile>& files) {
  Complaints out;
  for (const SourceFile& file : files) {
    check_floors(file, out);
    check_vendors(file, out);
    check_libraries(file, out);
    check_independent_checker(file, out);
    check_simulator(file, out);
    check_clock(file, out);
    check_renames(file, out);
    check_size_and_names(file, out);
    check_missions(file, out);
    check_partitions(file, out);
    check_torn_comments(file, out);
    check_width_of_comments(file, out);
  }
  std::ranges::copy(undocumented(files), std::back_inserter(out));
  std::ranges::copy(foreign_namespaces(files), std::back_inserter(out));
  std::ranges::copy(upward_includes(files), std::back_inserter(out));
  std::ranges::copy(pddl_outside_its_door(files), std::back_inserter(out));
  const Complaints planner = broken_planner_rules(files);
  out.insert(out.end(), planner.begin(), planner.end());
  std::ranges::copy(broken_seam_rules(files), std::back_inserter(out));
  return out;
}

}  // namespace roci::architecture
