// Whatever stands in a mission folder, every reader takes it or says what is wrong with which file; none
// crashes, hangs or lets another kind of error out.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <functional>
#include <iterator>
#include <stdexcept>

#include "arm_svc/functions.hpp"
#include "arm_svc/setup_file.hpp"
#include "core/mission/entry.hpp"
#include "core/mission/scenario.hpp"
#include "core/terrain/map_error.hpp"
#include "core/terrain/site_file.hpp"
#include "dedicated_svc/methods/methods_file.hpp"
#include "exec_svc/mission/mission_model.hpp"
#include "pathplan_svc/rover_file.hpp"
#include "science_svc/detector_file.hpp"
#include "services/process/connection.hpp"
#include "sim_svc/scenario/run_file.hpp"
#include "tests/fuzz/missions/mutate.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

namespace fs = std::filesystem;
using mission::Entry;

const fs::path kMission = ROCI_SOURCE_DIR "/missions/planetary";

std::string read(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

void write(const fs::path& path, const std::string& text) { std::ofstream(path, std::ios::binary) << text; }

struct Reader {
  const char* name;
  std::function<void(const fs::path& folder)> read;
};

const std::vector<Reader> kReaders{
    {"exec_svc", [](const fs::path& folder) { exec::mission::read_mission(folder); }},
    {"sim_svc", [](const fs::path& folder) { sim::scenario::load_run(folder, "opportunistic"); }},
    {"arm_svc",
     [](const fs::path& folder) { arm::load_setup(folder / "arm/arm.urdf", folder / "arm/poses.yaml"); }},
    {"arm functions",
     [](const fs::path& folder) {
       const auto setup = arm::load_setup(folder / "arm/arm.urdf", folder / "arm/poses.yaml");
       arm::read_module(Entry::load(folder / "arm.yaml"), setup);
     }},
    {"pathplan_svc",
     [](const fs::path& folder) {
       const Entry root = Entry::load(folder / "mission.yaml");
       if (const auto rover = root.find("rover")) pathplan::read_rover(*rover);
     }},
    {"dedicated_svc",
     [](const fs::path& folder) {
       dedicated::methods::read_methods(Entry::load(folder / "dedicated.yaml").at("dedicated"));
     }},
    {"science_svc",
     [](const fs::path& folder) {
       science::read_detector(Entry::load(folder / "mission.yaml"),
                              mission::load_scenario(folder, "opportunistic"));
     }},
    {"site", [](const fs::path& folder) { terrain::load_site(folder / "site/site.yaml"); }},
    {"connection",
     [](const fs::path& folder) {
       services::process::ConnectionFlags flags;
       flags.network = folder / "network.yaml";
       services::process::resolve_connection(
           flags, [](const char*) { return std::nullopt; }, folder);
     }},
};

// Empty: taken, or refused as it should be.
std::string wrong_with(const Reader& reader, const fs::path& folder) {
  try {
    reader.read(folder);
  } catch (const mission::FileError&) {
  } catch (const terrain::MapError&) {
  } catch (
      const std::invalid_argument& error) {  // of a value that might have come from the command line, too
    if (!std::string(error.what()).starts_with(folder.string()))
      return std::string(reader.name) + ": " + error.what();
  } catch (const std::exception& error) {
    return std::string(reader.name) + " lets out: " + error.what();
  }
  return "";
}

class FuzzMissions : public testing::TestWithParam<const char*> {
 protected:
  FuzzMissions() : folder_(fs::temp_directory_path() / ("roci-fuzz-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::copy(kMission, folder_, fs::copy_options::recursive);
    write(folder_ / "network.yaml",
          "dds: fastdds\ndomain: 7\naddress: 127.0.0.1\npeers: [127.0.0.1, 127.0.0.2]\n");
    write(folder_ / "arm.yaml",
          "module: shifting\nfunctions:\n"
          "  reach_for: {parameters: [slot], gives: duration, from: stow, to: \"?1\"}\n"
          "  shift: {parameters: [thing, slot, slot], gives: energy, from: \"?2\", to: \"?3\",\n"
          "          payload: {mass_kg: \"?1.mass_kg\", size_m: [0.4, \"?1.edge_m\", 0.4]}}\n");
    write(folder_ / "dedicated.yaml",
          "dedicated:\n  timeline: r.loco\n  subsystem: loco\n  methods:\n    go:\n      arguments: [wp]\n   "
          "   calls:\n"
          "        - {name: a, path: {planner: p, from: {robot: r}, to: {object: \"{wp}\"}}, within_s: 30}\n"
          "        - {name: b, command: {owner: o, subsystem: s, name: c, arguments: {x: \"{a.next_x}\"}},\n"
          "           check: {energy: {at_most: 3}}}\n"
          "      repairs: {no-go: {calls: [{name: d, observe: {timeline: t, is: [s, \"{wp}\"]}}], then: a, "
          "at_most: 2}}\n"
          "      results: {length: \"{a.length_m}\"}\n      then: [at, \"{wp}\"]\n");
  }
  ~FuzzMissions() override { fs::remove_all(folder_); }

  fs::path folder_;
};

TEST_P(FuzzMissions, IsTakenOrRefusedWithItsPlace) {
  const fs::path path = folder_ / GetParam();
  const std::string whole = read(path);
  ASSERT_FALSE(whole.empty());
  for (const Reader& reader : kReaders) EXPECT_NO_THROW(reader.read(folder_)) << reader.name;
  std::mt19937_64 random(std::string_view(GetParam()).size());
  for (int round = 0; round < rounds(150); ++round) {
    const std::string text = damage(whole, random);
    write(path, text);
    for (const Reader& reader : kReaders)
      ASSERT_EQ(wrong_with(reader, folder_), "") << "round " << round << ":\n" << text;
  }
}

INSTANTIATE_TEST_SUITE_P(Files, FuzzMissions,
                         testing::Values("mission.yaml", "domain.pddl", "scenarios/opportunistic.yaml",
                                         "arm/arm.urdf", "arm/poses.yaml", "arm.yaml", "dedicated.yaml",
                                         "site/site.yaml", "site/rocks.pgm", "network.yaml"),
                         [](const auto& test) {
                           std::string name = test.param;
                           for (char& c : name) c = c == '/' || c == '.' ? '_' : c;
                           return name;
                         });

}  // namespace
}  // namespace roci::fuzz
