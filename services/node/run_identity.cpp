#include "services/node/run_identity.hpp"

#include <algorithm>
#include <utility>

#include "services/log/log.hpp"

namespace roci::services::node {
namespace {

// What a stranger writes reaches logs and terminals: its control characters do not, and it is not long.
std::string printable(std::string name) {
  constexpr std::size_t kLongest = 64;
  if (name.size() > kLongest) name = name.substr(0, kLongest) + "...";
  std::ranges::replace_if(
      name, [](unsigned char c) { return c < 0x20 || c >= 0x7f; }, '?');
  return name;
}

}  // namespace

RunIdentity::RunIdentity(std::string node, std::string run, bool joins)
    : node_(std::move(node)), run_(std::move(run)), joins_(joins) {}

bool RunIdentity::obeys(const std::string& sample_run, const std::string& topic) {
  if (joins_ && run_.empty()) run_ = sample_run;
  if (sample_run == run_) return true;
  if (const auto known = foreign_.find(sample_run); known != foreign_.end()) {
    ++known->second;
  } else if (foreign_.size() < kForeignRuns) {
    foreign_[sample_run] = 1;
    news_.emplace_back(printable(sample_run), topic);
    log::warning(node_ + " hears another run, \"" + printable(sample_run) + "\", on " + topic +
                 " and does not obey it; give each run a domain of its own");
  }
  return false;
}

}  // namespace roci::services::node
