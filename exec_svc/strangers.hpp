// This file says which senders an executive may believe, and what operators are told of the others.
#pragma once

#include <algorithm>
#include <functional>
#include <map>
#include <set>
#include <string>

#include "exec_svc/reactor/messages.hpp"

namespace roci::exec {

/// Gives each timeline one source: the first sender that tells of it, until that one is lost. A second owner of a
/// subsystem thus changes no belief.
class TimelineSources {
 public:
  /// Returns whether `sender` is the timeline's source, which it becomes if there is none.
  bool admit(const std::string& timeline, const std::string& sender) {
    return sources_.try_emplace(timeline, sender).first->second == sender;
  }
  /// Returns the timeline's source, or "" if there is none.
  std::string source(const std::string& timeline) const {
    const auto found = sources_.find(timeline);
    return found == sources_.end() ? "" : found->second;
  }
  /// Returns whether the service is the source of any timeline.
  bool observes(const std::string& service) const {
    return std::ranges::any_of(sources_, [&](const auto& one) { return one.second == service; });
  }
  /// Forgets a lost service, so that another one may take its place.
  void forget(const std::string& service) {
    std::erase_if(sources_, [&](const auto& one) { return one.second == service; });
  }

 private:
  std::map<std::string, std::string> sources_;
};

/// Tells operators of each stranger once, up to a bounded number of them.
class Strangers {
 public:
  using Report = std::function<void(const reactor::Event&)>;
  explicit Strangers(Report report) : report_(std::move(report)) {}

  void tell(const std::string& code, const std::string& text) {
    if (told_.size() >= kMost || !told_.insert(code + " " + text).second) return;
    report_({reactor::Severity::warning, code, text});
  }

 private:
  static constexpr std::size_t kMost = 100;
  Report report_;
  std::set<std::string> told_;
};

}  // namespace roci::exec
