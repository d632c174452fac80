#include "exec_svc/trace/run_reader.hpp"

#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "exec_svc/trace/journal_reader.hpp"
#include "exec_svc/trace/trace_text.hpp"

namespace roci::exec::trace {
namespace {

namespace fs = std::filesystem;

/// This is the newest version of summary.json that is understood here; one that names none is of version 1.
constexpr int kSummaryFormat = 1;

constexpr char kSummary[] = "summary.json";
constexpr char kJournal[] = "journal.sqlite";
constexpr char kText[] = ".trace";

nlohmann::json summary_beside(const fs::path& folder) {
  const fs::path file = folder / kSummary;
  std::ifstream in(file);
  if (!in) return nlohmann::json::object();
  auto summary = nlohmann::json::parse(in, nullptr, false);
  if (!summary.is_object())
    throw TraceError(file.string() + " is no JSON object; remove it, or give the journal alone elsewhere");
  const int format = summary.value("format", 1);
  if (format > kSummaryFormat)
    throw TraceError(file.string() + ": a summary of format " + std::to_string(format) +
                     ", this roci-trace reads up to " + std::to_string(kSummaryFormat) +
                     "; read it with the version that wrote it");
  return summary;
}

RecordedTrace from_journal(const fs::path& journal, const nlohmann::json& summary, bool decisions) {
  RecordedTrace out;
  out.scenario = summary.value("scenario", "");
  if (summary.contains("seed")) out.seed = summary.at("seed").get<std::uint64_t>();
  out.decisions = decisions;
  out.lines = read_journal(journal, decisions);
  return out;
}

std::string journals_of(const nlohmann::json& executives) {
  std::string out;
  for (const auto& [name, summary] : executives.items())
    out += (out.empty() ? "" : ", ") + summary.value("journal", kJournal);
  return out;
}

RecordedTrace from_folder(const fs::path& folder, bool decisions) {
  const auto summary = summary_beside(folder);
  if (summary.contains("executives"))
    throw TraceError(folder.string() + " holds the runs of several executives; give one of: " +
                     journals_of(summary.at("executives")));
  const fs::path journal = folder / summary.value("journal", kJournal);
  if (!fs::is_regular_file(journal))
    throw TraceError("there is no journal " + journal.string() +
                     "; give a run folder, its journal.sqlite or a text of roci-trace print");
  return from_journal(journal, summary, decisions);
}

bool is_sqlite(std::ifstream& in) {
  std::array<char, 15> begin{};
  in.read(begin.data(), begin.size());
  const bool is = in.gcount() == static_cast<std::streamsize>(begin.size()) &&
                  std::string_view(begin.data(), begin.size()) == "SQLite format 3";
  in.clear();
  in.seekg(0);
  return is;
}

RecordedTrace from_text(std::ifstream& in, const fs::path& file, bool decisions) {
  RecordedTrace out = parse(in, file.string());
  if (decisions && !out.decisions)
    throw TraceError(file.string() +
                     ":1: the text holds the trace alone; write it with: roci-trace print --decisions");
  return decisions ? out : without_decisions(std::move(out));
}

bool is_run_folder(const fs::path& path) {
  return fs::is_regular_file(path / kSummary) || fs::is_regular_file(path / kJournal);
}

}  // namespace

RecordedTrace read_run(const fs::path& run, bool decisions) {
  if (fs::is_directory(run)) return from_folder(run, decisions);
  std::ifstream in(run, std::ios::binary);
  if (!in) throw TraceError(run.string() + " cannot be read; check that it exists");
  if (!is_sqlite(in)) return from_text(in, run, decisions);
  return from_journal(run, summary_beside(run.parent_path()), decisions);
}

std::map<std::string, fs::path> runs_in(const fs::path& folder) {
  std::map<std::string, fs::path> out;
  if (!fs::is_directory(folder) || is_run_folder(folder)) return out;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory() && is_run_folder(entry.path()))
      out[entry.path().filename().string()] = entry.path();
    if (entry.is_regular_file() && entry.path().extension() == kText)
      out[entry.path().stem().string()] = entry.path();
  }
  return out;
}

}  // namespace roci::exec::trace
