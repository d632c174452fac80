#include "sim_svc/run_records.hpp"

#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace roci::sim {
namespace {

constexpr std::string_view kEnd = "\n]\n";  // of begun.json

std::string line_of(const nlohmann::json& entry) {
  return entry.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace

RunRecords::RunRecords(const std::filesystem::path& run_folder, std::uint32_t incarnation)
    : incarnation_(incarnation) {
  if (run_folder.empty()) return;
  effects_.open(run_folder / "effects.jsonl", std::ios::app);
  products_.open(run_folder / "products.jsonl", std::ios::app);
  begun_.open(run_folder / "begun.json");
  begun_ << "[" << kEnd << std::flush;
}

void RunRecords::add(const world::Effect& one) {
  effects_ << nlohmann::json{{"time_us", one.at.count()},    {"robot", one.robot},
                             {"component", one.component},   {"kind", one.effect.kind},
                             {"object", one.effect.object},  {"commander", one.cause.commander},
                             {"epoch", one.cause.epoch},     {"activity", one.cause.activity},
                             {"attempt", one.cause.attempt}, {"incarnation", incarnation_}}
                  .dump()
           << std::endl;
}

void RunRecords::add(const world::Product& product, temporal::Time now) {
  products_ << line_of({{"time_us", now.count()},
                        {"robot", product.robot},
                        {"id", product.id},
                        {"kind", product.kind},
                        {"source", product.source},
                        {"bytes", product.bytes},
                        {"tier", world::name_of(product.tier)},
                        {"fate", world::name_of(product.fate)}})
            << std::endl;
}

// One array, written as it grows, and whole however the process ends.
void RunRecords::add(const world::Begun& one) {
  const nlohmann::json entry{{"time_us", one.at.count()},         {"robot", one.robot},
                             {"component", one.component},        {"commander", one.task.key.commander},
                             {"activity", one.task.key.activity}, {"attempt", one.task.key.attempt},
                             {"command", one.task.command},       {"arguments", one.task.arguments}};
  begun_.seekp(-static_cast<std::streamoff>(kEnd.size()), std::ios::end);
  begun_ << std::exchange(begun_separator_, ",\n") << line_of(entry) << kEnd << std::flush;
}

}  // namespace roci::sim
