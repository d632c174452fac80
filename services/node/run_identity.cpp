#include "services/node/run_identity.hpp"

#include <utility>

#include "services/log/log.hpp"

namespace roci::services::node {

RunIdentity::RunIdentity(std::string node, std::string run, bool joins)
    : node_(std::move(node)), run_(std::move(run)), joins_(joins) {}

bool RunIdentity::obeys(const std::string& sample_run, const std::string& topic) {
  if (joins_ && run_.empty()) run_ = sample_run;
  if (sample_run == run_) return true;
  if (const auto known = foreign_.find(sample_run); known != foreign_.end()) {
    ++known->second;
  } else if (foreign_.size() < kForeignRuns) {
    foreign_[sample_run] = 1;
    news_.emplace_back(sample_run, topic);
    log::warning(node_ + " hears another run, \"" + sample_run + "\", on " + topic +
                 " and does not obey it; give each run a domain of its own");
  }
  return false;
}

}  // namespace roci::services::node
