// A mission that is copied and broken by one edit, and what the check finds in it.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "rehearsal/check/mission_check.hpp"

namespace roci::rehearsal::check {

namespace fs = std::filesystem;

inline const fs::path kPlanetary = ROCI_SOURCE_DIR "/missions/planetary";
inline const fs::path kQuarry = ROCI_BINARY_DIR "/tests/missions/quarry";

inline std::string text_of(const fs::path& file) {
  std::ostringstream text;
  text << std::ifstream(file, std::ios::binary).rdbuf();
  return text.str();
}

// The findings as they are printed, a line each.
inline std::vector<std::string> printed(const CheckReport& report) {
  std::vector<std::string> out;
  for (const auto& one : report.findings.sorted()) out.push_back(one.text() + "; " + one.remedy);
  return out;
}

// A copy of a mission with those of its scenarios that are broken here; what is large in it is linked.
class CopiedMission {
 public:
  explicit CopiedMission(const fs::path& mission)
      : folder_(fs::temp_directory_path() / ("roci_check_" + std::to_string(::getpid())) /
                mission.filename()) {
    fs::remove_all(folder_);
    fs::create_directories(folder_);
    for (const auto& entry : fs::directory_iterator(mission)) {
      const fs::path to = folder_ / entry.path().filename();
      if (entry.path().filename() == "bin") {
        fs::create_directory_symlink(fs::absolute(entry.path()), to);
      } else {
        fs::copy(entry.path(), to, fs::copy_options::recursive);
      }
    }
    for (const char* name : {"battery_low", "blocked_window", "map_changes", "opportunistic"})
      fs::remove(folder_ / "scenarios" / (std::string(name) + ".yaml"));
  }
  ~CopiedMission() { fs::remove_all(folder_.parent_path()); }

  const fs::path& folder() const { return folder_; }

  // Beside the images of the site one that is too small and one that was cut off.
  void make_images() const {
    if (!fs::exists(folder_ / "site")) return;
    std::ofstream(folder_ / "site/small.pgm", std::ios::binary) << "P5\n3 2\n255\nabcdef";
    std::ofstream(folder_ / "site/cut.pgm", std::ios::binary) << "P5\n240 240\n255\nabc";
  }

  // Replaces the first place of `right`; returns the line in which it stands.
  int edit(const std::string& file, const std::string& right, const std::string& wrong) const {
    std::string text = text_of(folder_ / file);
    const std::size_t at = text.find(right);
    EXPECT_NE(at, std::string::npos) << right << " does not stand in " << file;
    if (at == std::string::npos) return 0;
    text.replace(at, right.size(), wrong);
    std::ofstream(folder_ / file, std::ios::binary) << text;
    return 1 +
           static_cast<int>(std::count(text.begin(), text.begin() + static_cast<std::ptrdiff_t>(at), '\n'));
  }

 private:
  fs::path folder_;
};

inline constexpr char kMission[] = "mission.yaml";
inline constexpr char kNominal[] = "scenarios/nominal.yaml";

struct Slip {
  const char* file;
  const char* right;
  const char* wrong;
  const char* what;
  const char* remedy;
  // Where it is told, if not where it was made: the line of this text in mission.yaml, "FILE name": in that file, or
  // "BELOW": in the line below.
  const char* told_at = "";
};

inline void PrintTo(const Slip& slip, std::ostream* out) { *out << slip.wrong; }

inline void expect_found(const fs::path& mission, const Slip& slip) {
  const CopiedMission copy(mission);
  copy.make_images();
  int line = copy.edit(slip.file, slip.right, slip.wrong);
  std::string file = slip.file;
  const std::string told_at = slip.told_at;
  if (told_at.starts_with("FILE ")) {
    file = told_at.substr(5);
    line = -1;
  } else if (told_at == "BELOW") {
    ++line;
  } else if (!told_at.empty()) {
    file = "mission.yaml";
    line = copy.edit(file, slip.told_at, slip.told_at);
  }
  const CheckReport report = check_mission(copy.folder());
  ASSERT_EQ(report.findings.size(), 1U) << ::testing::PrintToString(printed(report));
  const mission::Finding& finding = report.findings.all().front();
  EXPECT_EQ(fs::path(finding.file), copy.folder() / file) << finding.text();
  if (line >= 0) {
    EXPECT_EQ(finding.line, line) << finding.text();
    EXPECT_GT(finding.column, 0) << finding.text();
  }
  EXPECT_THAT(finding.what, ::testing::HasSubstr(slip.what));
  EXPECT_THAT(finding.remedy, ::testing::HasSubstr(slip.remedy));
}

}  // namespace roci::rehearsal::check
