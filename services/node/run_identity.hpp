// Which run a node belongs to, and which samples it obeys: those of its own run alone.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace roci::services::node {

class RunIdentity {
 public:
  /// `run`: the identity that the launcher gave. With `joins` (observers)
  /// an empty one stands for the first run that is heard.
  RunIdentity(std::string node, std::string run, bool joins);

  /// Stamped into every sample that the node writes; empty as long as an observer has heard of none.
  const std::string& name() const { return run_; }

  /// Whether a sample that names `sample_run` is to be obeyed. The first sample of each foreign run is worth a line in
  /// the log, for at most kForeignRuns of them.
  bool obeys(const std::string& sample_run, const std::string& topic);

  /// Returns the foreign runs that were heard for the first time since the last call, each with the topic.
  std::vector<std::pair<std::string, std::string>> take_news() { return std::exchange(news_, {}); }

  /// Samples of other runs that were left unread, by run.
  const std::map<std::string, std::uint64_t>& foreign() const { return foreign_; }

  static constexpr std::size_t kForeignRuns = 16;

 private:
  std::string node_;
  std::string run_;
  bool joins_;
  std::map<std::string, std::uint64_t> foreign_;
  std::vector<std::pair<std::string, std::string>> news_;
};

}  // namespace roci::services::node
