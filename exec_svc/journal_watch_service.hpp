/// What operators are told of an executive's journal: damage that was found in it, and that it waits for its disk.
#pragma once

#include <functional>
#include <string>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/reactor/messages.hpp"
#include "services/process/disk_pause.hpp"

namespace roci::exec {

/// Returns whether the journal was found damaged, or without its end, and nobody has been told.
bool is_in_doubt(const journal::Journal&);

class JournalWatch {
 public:
  using Report = std::function<void(const reactor::Event&)>;

  /// The journal outlives this, and waits for its disk by `pause` until stop(). What is not durable is neither
  /// acknowledged nor commanded, so nothing else can be done meanwhile.
  JournalWatch(journal::Journal&, services::process::DiskPause pause, Report);

  /// Tells of damage that was found, once: the journal forgets it, and the ground has been told once that is durable.
  void tell_damage();
  /// From now on the journal throws where its disk takes nothing.
  void stop() { journal_.wait_for_disk({}); }

 private:
  void wait(const std::string& cause);
  void go_on();

  journal::Journal& journal_;
  services::process::DiskPause pause_;
  Report report_;
  std::string cause_;  // why it was waited for
};

}  // namespace roci::exec
