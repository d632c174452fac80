// The journal watch tells operators of damage that was found in an executive's journal, and that the journal waits
// for its disk.
#pragma once

#include <functional>
#include <string>

#include "exec_svc/journal/journal.hpp"
#include "exec_svc/reactor/messages.hpp"
#include "services/process/disk_pause.hpp"

namespace roci::exec {

/// Returns whether the journal was found damaged, or without its end, and nobody has been told.
bool is_in_doubt(const journal::Journal&);

/// Reports once what the journal was found to lack, and each wait of the journal for its disk with its end.
class JournalWatch {
 public:
  using Report = std::function<void(const reactor::Event&)>;

  /// Lets the journal, which must outlive this object, wait for its disk by `pause` until stop(). What is not
  /// durable is neither acknowledged nor commanded, so nothing else can be done meanwhile.
  JournalWatch(journal::Journal&, services::process::DiskPause pause, Report);

  /// Reports damage that was found, once: the journal then forgets it, and once that is durable the ground counts as
  /// told.
  void tell_damage();
  /// Lets the journal throw from now on where its disk takes nothing.
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
