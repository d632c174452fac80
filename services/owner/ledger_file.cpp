#include "services/owner/ledger_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "core/durable/durable_file.hpp"
#include "services/log/log.hpp"
#include "services/owner/value_json.hpp"

namespace roci::services::owner {
namespace {

using nlohmann::json;

json to_json(const CommandStatus& status) {
  json out{{"stage", static_cast<int>(status.stage)}, {"code", status.code}, {"reason", status.reason}};
  if (status.results.duration) out["duration_us"] = status.results.duration->count();
  if (status.results.energy_j) out["energy_j"] = *status.results.energy_j;
  for (const auto& [name, value] : status.results.values) out["values"][name] = owner::to_json(value);
  return out;
}

CommandStatus status_in(const json& in) {
  const int stage = in.at("stage").get<int>();
  if (stage < static_cast<int>(Stage::rejected) || stage > static_cast<int>(Stage::cancelled))
    throw std::invalid_argument("stage " + std::to_string(stage) + " is no last status");
  CommandStatus out{
      static_cast<Stage>(stage), in.at("code").get<std::string>(), in.at("reason").get<std::string>(), {}};
  if (in.contains("duration_us"))
    out.results.duration = temporal::Duration(in["duration_us"].get<std::int64_t>());
  if (in.contains("energy_j") && in["energy_j"].is_number())
    out.results.energy_j = in["energy_j"].get<double>();
  const json values = in.value("values", json::object());
  for (const auto& [name, value] : values.items()) out.results.values[name] = owner::value_in(value);
  return out;
}

json to_json(const LedgerEntry& entry) {
  json out{{"commander", entry.key.commander},
           {"issued", entry.key.issued_epoch},
           {"activity", entry.key.activity},
           {"attempt", entry.key.attempt}};
  if (entry.epoch > 0) {
    out["sender"] = entry.sender;
    out["epoch"] = entry.epoch;
  }
  if (entry.status) out["word"] = to_json(*entry.status);
  if (entry.plan > 0) out["plan"] = entry.plan;
  if (entry.kind == LedgerEntry::Kind::epoch) out["only"] = "epoch";
  if (entry.kind == LedgerEntry::Kind::forgotten) out["only"] = "forgotten";
  return out;
}

std::string line_of(const LedgerEntry& entry) {
  return to_json(entry).dump(-1, ' ', false, json::error_handler_t::replace) + "\n";
}

LedgerEntry entry_in(const json& in) {
  LedgerEntry out;
  out.key = {in.at("activity").get<std::string>(), in.at("attempt").get<std::uint32_t>(),
             in.at("commander").get<std::string>(), in.at("issued").get<std::uint64_t>()};
  out.sender = in.value("sender", "");
  out.epoch = in.value("epoch", std::uint64_t{0});
  if (in.contains("word")) out.status = status_in(in["word"]);
  out.plan = in.value("plan", std::uint32_t{0});
  const std::string only = in.value("only", "");
  if (only == "epoch") out.kind = LedgerEntry::Kind::epoch;
  if (only == "forgotten") out.kind = LedgerEntry::Kind::forgotten;
  return out;
}

}  // namespace

namespace {

int open_for_appending(const std::filesystem::path& file, int more = 0) {
  const int descriptor =
      open(file.c_str(), O_WRONLY | O_CREAT | O_APPEND | O_CLOEXEC | O_NOFOLLOW | more, 0600);
  if (descriptor < 0) throw std::system_error(errno, std::generic_category(), "cannot open " + file.string());
  return descriptor;
}

}  // namespace

LedgerFile::LedgerFile(std::filesystem::path file)
    : file_(std::move(file)), descriptor_(open_for_appending(file_)) {
  // A line that its writer did not finish must not swallow the next one.
  std::ifstream in(file_, std::ios::binary | std::ios::ate);
  if (in.tellg() <= 0) return;
  in.seekg(-1, std::ios::end);
  torn_ = in.get() != '\n';
}

LedgerFile::~LedgerFile() { close(descriptor_); }

std::vector<LedgerEntry> LedgerFile::read() const {
  std::vector<LedgerEntry> out;
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    if (line.empty()) continue;
    try {
      out.push_back(entry_in(json::parse(line)));
    } catch (const std::exception& error) {
      log::warning(file_.string() + ": a line cannot be read and is left out: " + error.what());
    }
  }
  return out;
}

void LedgerFile::append(const LedgerEntry& entry) {
  const std::string line = (torn_ ? "\n" : "") + line_of(entry);
  const ssize_t written = write(descriptor_, line.data(), line.size());
  if (written == static_cast<ssize_t>(line.size())) {
    torn_ = false;
    ++appended_;
    return;
  }
  torn_ = torn_ || written > 0;
  throw std::system_error(errno, std::generic_category(), "cannot write " + file_.string());
}

void LedgerFile::replace(const std::vector<LedgerEntry>& entries) {
  std::string text;
  for (const LedgerEntry& entry : entries) text += line_of(entry);
  const std::filesystem::path next = std::filesystem::path(file_).concat(".new");
  const int descriptor = open_for_appending(next, O_TRUNC);
  const auto give_up = [&](int cause) {
    close(descriptor);
    unlink(next.c_str());
    throw std::system_error(cause, std::generic_category(), "cannot write " + next.string());
  };
  if (write(descriptor, text.data(), text.size()) != static_cast<ssize_t>(text.size())) give_up(errno);
  if (fsync(descriptor) != 0) give_up(errno);
  try {
    durable::put_in_place(next, file_, durable::Durability::process);
  } catch (const std::system_error& error) {
    give_up(error.code().value());
  }
  close(std::exchange(descriptor_, descriptor));
  torn_ = false;
  appended_ = 0;
  durable::sync_folder(std::filesystem::path(file_).parent_path());
}

}  // namespace roci::services::owner
