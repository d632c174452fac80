#include "exec_svc/journal_watch_service.hpp"

#include <utility>

#include "exec_svc/journal/salvage.hpp"
#include "services/log/log.hpp"

namespace roci::exec {

using journal::Journal;
using reactor::Severity;

bool is_in_doubt(const Journal& journal) {
  return !journal.text(journal::kDamage).empty() || !journal.text(journal::kShortened).empty();
}

JournalWatch::JournalWatch(Journal& journal, services::process::DiskPause pause, Report report)
    : journal_(journal), pause_(std::move(pause)), report_(std::move(report)) {
  journal_.wait_for_disk({[this](const std::string& cause) { wait(cause); }, [this] { go_on(); }});
}

void JournalWatch::tell_damage() {
  for (const auto& [name, code] : {std::pair(journal::kDamage, "journal.damaged"),
                                   std::pair(journal::kShortened, "journal.shortened")}) {
    const std::string text = journal_.text(name);
    if (text.empty()) continue;
    services::log::error(text);
    report_({Severity::error, code, text});
    journal_.set_text(name, "");
  }
}

void JournalWatch::wait(const std::string& cause) {
  if (!pause_.wait()) return;
  services::log::error("exec_svc waits for its disk: " + cause);
  report_({Severity::error, "journal.waiting",
           "the journal cannot be written (" + cause +
               "); nothing is acknowledged or commanded until it can; make room on the disk"});
  cause_ = cause;
}

void JournalWatch::go_on() {
  const std::string text =
      "the journal was written after " + std::to_string(pause_.over()) + " s (" + cause_ + ")";
  services::log::warning("exec_svc goes on: " + text);
  report_({Severity::warning, "journal.written", text});
}

}  // namespace roci::exec
