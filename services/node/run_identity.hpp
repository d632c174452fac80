// The run identity says which run a node belongs to, and which samples it obeys.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace roci::services::node {

/// Lets a node obey the samples of its own run alone.
class RunIdentity {
 public:
  /// Takes the identity `run` that the launcher gave. With `joins` (observers) an empty one stands for the
  /// first run that is heard.
  RunIdentity(std::string node, std::string run, bool joins);

  /// Returns the name that every sample of the node carries, empty as long as an observer has heard of no
  /// run.
  const std::string& name() const { return run_; }

  /// Returns whether a sample that names `sample_run` is to be obeyed. The first sample of each foreign run
  /// writes a line in the log, for at most kForeignRuns of them.
  bool obeys(const std::string& sample_run, const std::string& topic);

  /// Returns the foreign runs that were heard for the first time since the last call, each with the topic.
  std::vector<std::pair<std::string, std::string>> take_news() { return std::exchange(news_, {}); }

  /// Returns how many samples of other runs were left unread, by run.
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
