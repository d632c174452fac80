// The files of a run folder and of the folder of running missions, damaged: records, summaries,
// reports, counts, recordings.
#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <functional>
#include <nlohmann/json.hpp>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include "core/mission/service_list.hpp"
#include "dedicated_svc/call_record_service.hpp"
#include "exec_svc/journal/high_water_mark.hpp"
#include "exec_svc/journal/journal.hpp"
#include "exec_svc/standby/persisted_term_file.hpp"
#include "exec_svc/trace/recorded_trace.hpp"
#include "exec_svc/trace/run_reader.hpp"
#include "ground_console/cli/runs.hpp"
#include "services/launch/continuation.hpp"
#include "services/launch/summary.hpp"
#include "services/process/incarnation.hpp"
#include "services/process/link_report.hpp"
#include "services/process/run_record.hpp"
#include "services/process/run_summary.hpp"
#include "services/service.hpp"
#include "sim_svc/world_file_service.hpp"
#include "tests/fuzz/files/damage.hpp"
#include "tests/fuzz/rounds.hpp"

namespace roci::fuzz {
namespace {

namespace fs = std::filesystem;
namespace process = services::process;

struct Reader {
  std::string file;  // of the run folder
  std::string whole;
  std::function<void(const fs::path& folder)> read;
};

const std::string kSummary =
    R"({"format":1,"mission":"planetary","result":"partial","goals":{"achieved":2,"dropped":1,"failed":0},)"
    R"("planner":{"calls":3,"max_s":0.5,"max_rss_mb":80.5},"replans":1,"sim_s":2517.3,"trace_sha256":"ab"})";

class FuzzRunFiles : public testing::Test {
 protected:
  FuzzRunFiles() : folder_(fs::temp_directory_path() / ("roci-fuzz-run-" + std::to_string(getpid()))) {
    fs::remove_all(folder_);
    fs::create_directories(folder_ / "links");
    fs::create_directories(folder_ / "20260101T000000Z-a");
  }
  ~FuzzRunFiles() override { fs::remove_all(folder_); }

  std::vector<Reader> readers() const {
    const std::string record =
        R"({"format":1,"pid":)" + std::to_string(getpid()) +
        R"(,"domain":7,"mission":"/m","scenario":"nominal","dds":"fastdds","address":"127.0.0.1","peers":["127.0.0.1"],)"
        R"("run_folder":"/r","clock":"live","started_unix_us":1,"run":"planetary"})";
    return {
        {"1.json", record,
         [](const fs::path& folder) {
           process::find_runs(folder);
           process::refused_runs(folder);
         }},
        {"summary.json", kSummary, [this](const fs::path& folder) { process::read_summary(folder, list_); }},
        {"links/exec_svc.json",
         R"({"up":{"offered":9,"arrived":8,"lost":1,"superseded":0,"under_way":0,"repeated":2}})",
         [](const fs::path& folder) { process::read_link_reports(folder); }},
        {"arm_svc.incarnation", "3\n",
         [](const fs::path& folder) { process::next_incarnation(folder, "arm_svc"); }},
        {"loco.calls",
         R"({"epoch":7,"open":{"activity":"exec/1/p1.2-a/3","attempt":1,"commander":"loco","epoch":7,"owner":"sim_svc"}})",
         [](const fs::path& folder) { dedicated::CallRecord(folder / "loco.calls").open(); }},
        {"first.term", "12 1 0 2479074010\n",
         [](const fs::path& folder) {
           exec::standby::PersistedTermFile(folder / "first.term", exec::journal::Durability::process).read();
         }},
        {"journal.sqlite-mark", "                   3                   17  4831190261231\n",
         [](const fs::path& folder) { exec::journal::HighWaterMark(folder / "journal.sqlite").read(); }},
        {"20260101T000000Z-a/summary.json", kSummary,
         [](const fs::path& folder) { console::cli::runs_text(console::cli::past_runs(folder, {})); }},
        {"sim_svc.world",
         R"({"at_us":5,"robots":{"rover":{"pose":[1,2,0],"energy_j":3e5,"images":{"a":{"robot":"rover","source":"b","bytes":9,)"
         R"("sent":false,"taken_us":4,"taken_from":[1,2,0],"preview":[1,2]}},"components":{"arm":{"held":true}}}},"samples":{"s":"a"}})",
         [](const fs::path& folder) { sim::WorldFile(folder / "sim_svc.world").read(); }},
        {"launch.json",
         R"({"format":1,"clock":"live","arguments":["/m","--seed","1"],"epoch_unix_us":5,"anchor":"","launchers":1})",
         [](const fs::path& folder) {
           const std::vector<const char*> line{"roci-launch", "--resume", folder.c_str()};
           try {
             services::launch::continued_command_line(static_cast<int>(line.size()), line.data());
           } catch (const std::invalid_argument&) {
           }
         }},
        {"expected.json", R"({"events":3,"met":true,"fault":""})",
         [](const fs::path& folder) {
           services::launch::Options options;
           options.mission = ROCI_SOURCE_DIR "/missions/planetary";
           options.run_folder = folder;
           services::launch::complete_summary(options, 1, true);
         }},
    };
  }

  const mission::ServiceList list_ = mission::load_service_list(ROCI_SOURCE_DIR "/missions/planetary");
  fs::path folder_;
  std::mt19937_64 random_{1};
};

// A refusal is an error in words (std::runtime_error, or std::invalid_argument of a command line), which the programs
// print; anything else would end them.
TEST_F(FuzzRunFiles, AreReadOrRefused) {
  for (const Reader& reader : readers()) {
    const fs::path file = folder_ / reader.file;
    write_bytes(file, reader.whole);
    ASSERT_NO_THROW(reader.read(folder_)) << reader.file;
    for (int round = 0; round < rounds(300); ++round) {
      const std::string text = damaged(reader.whole, random_);
      write_bytes(file, text);
      try {
        reader.read(folder_);
      } catch (const std::runtime_error& refused) {
        EXPECT_EQ(std::string(refused.what()).find("json.exception"), std::string::npos)
            << reader.file << ": " << refused.what() << "\n"
            << text;
      } catch (const std::exception& error) {
        FAIL() << reader.file << " lets out " << error.what() << ":\n" << text;
      }
    }
    fs::remove(file);
  }
}

TEST_F(FuzzRunFiles, ARecordedRunIsReadOrRefused) {
  {
    exec::journal::Journal journal(folder_ / "journal.sqlite", exec::journal::Durability::process);
    for (int i = 0; i < 20; ++i) {
      journal.append(temporal::seconds(i), "trace",
                     std::to_string(i) + "000000 observation rover.nav idle sampled 0");
      journal.append(temporal::seconds(i), "event", "plan.adopted p1");
    }
    journal.commit();
  }
  const std::string journal = read_bytes(folder_ / "journal.sqlite");
  for (int round = 0; round < rounds(60); ++round) {
    write_bytes(folder_ / "journal.sqlite", damaged(journal, random_));
    write_bytes(folder_ / "summary.json", damaged(kSummary, random_));
    for (const char* other : {"journal.sqlite-wal", "journal.sqlite-shm"}) fs::remove(folder_ / other);
    try {
      exec::trace::read_run(folder_, true);
    } catch (const exec::trace::TraceError&) {
    } catch (const std::exception& error) {
      FAIL() << "round " << round << " lets out " << error.what();
    }
  }
}

}  // namespace
}  // namespace roci::fuzz
