#include "dedicated_svc/call_record_service.hpp"

#include <fstream>
#include <nlohmann/json.hpp>
#include <utility>

#include "services/process/durable_file.hpp"

namespace roci::dedicated {

using services::commander::Issued;

CallRecord::CallRecord(std::filesystem::path file) : file_(std::move(file)) {
  std::ifstream in(file_);
  if (!in) return;
  try {
    const nlohmann::json json = nlohmann::json::parse(in);
    epoch_ = json.at("epoch").get<std::uint64_t>();
    if (const auto open = json.find("open"); open != json.end())
      open_ = Issued{{open->at("activity").get<std::string>(), open->at("attempt").get<std::uint32_t>(),
                      open->at("commander").get<std::string>(), open->at("epoch").get<std::uint64_t>()},
                     open->at("owner").get<std::string>()};
  } catch (const nlohmann::json::exception&) {
    damaged_ = true;
    epoch_ = 0;
    open_.reset();
  }
}

void CallRecord::begin(const Issued& issued) {
  epoch_ = issued.key.issued_epoch;
  open_ = issued;
  write();
}

void CallRecord::end() {
  open_.reset();
  write();
}

void CallRecord::write() const {
  if (file_.empty()) return;
  nlohmann::json json{{"epoch", epoch_}};
  if (open_)
    json["open"] = {{"activity", open_->key.activity},
                    {"attempt", open_->key.attempt},
                    {"commander", open_->key.commander},
                    {"epoch", open_->key.issued_epoch},
                    {"owner", open_->owner}};
  services::process::replace_file(file_, json.dump() + "\n");
}

}  // namespace roci::dedicated
