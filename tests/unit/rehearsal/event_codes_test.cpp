// The table of event codes is what the sources tell.
#include "rehearsal/check/event_codes.hpp"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <regex>
#include <set>
#include <sstream>

namespace roci::rehearsal::check {
namespace {

namespace fs = std::filesystem;

// Words of the same shape that are no codes: names of files, windows, partitions and places of files.
const std::set<std::string> kOthers{"activity.argument", "begun.json",     "call.error",
                                    "call.value",        "comm.window",    "contingencies.wipe-lens",
                                    "earth.window",      "effects.jsonl",  "expected.json",
                                    "identity.key",      "issued.json",    "journal.sqlite",
                                    "launch.json",       "launch.lock",    "mission.yaml",
                                    "orders.json",       "products.jsonl", "permissions.key",
                                    "revoked.pem",       "roci.inner",     "roci.team",
                                    "summary.json",      "sun.window"};

std::set<std::string> codes_in_sources() {
  std::set<std::string> out;
  const std::regex code("\"([a-z]+\\.[a-z_-]+)\"");
  for (const char* part : {"exec_svc", "services", "planner_svc", "sim_svc", "pathplan_svc", "dedicated_svc",
                           "arm_svc", "science_svc"}) {
    for (const auto& file : fs::recursive_directory_iterator(fs::path(ROCI_SOURCE_DIR) / part)) {
      if (file.path().extension() != ".cpp" && file.path().extension() != ".hpp") continue;
      std::ostringstream in;
      in << std::ifstream(file.path()).rdbuf();
      const std::string text = in.str();
      for (std::sregex_iterator match(text.begin(), text.end(), code), end; match != end; ++match)
        if (!kOthers.contains((*match)[1])) out.insert((*match)[1]);
    }
  }
  return out;
}

TEST(EventCodes, TheTableIsWhatTheSourcesTell) {
  const std::set<std::string> told = codes_in_sources();
  const std::set<std::string> table(event_codes().begin(), event_codes().end());
  for (const std::string& code : told)
    EXPECT_TRUE(table.contains(code)) << code << " is told; add it to event_codes.cpp, or to kOthers here";
  for (const std::string& code : table) EXPECT_TRUE(told.contains(code)) << code << " is told by nobody";
}

}  // namespace
}  // namespace roci::rehearsal::check
