// The call record is what a dedicated executive must know of itself after its death: in which epoch it commanded,
// which command was under way, how far the method had come, and the state that it showed.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <vector>

#include "dedicated_svc/method_run/method_run.hpp"
#include "services/commander/command_client.hpp"

namespace roci::dedicated {

/// Describes a command from above that is being carried out, as far as it has come.
struct RunRecord {
  services::owner::Request request;  ///< but for who sent it when
  temporal::Time begun{};
  temporal::Time call_begun{};                                 ///< of the call that is under way
  std::vector<method_run::Taken> taken{};                      ///< in their order
  std::optional<services::owner::CommandStatus> broken_off{};  ///< why it is to end early
};

/// Keeps calls in a small file, whole or not at all, before what it says is done. Where the disk does not take a
/// change, all is forgotten with the process: an old word would have things done twice. Changes throw
/// std::system_error then.
class CallRecord {
 public:
  /// Reads the file, if there is one. An empty path keeps nothing. `around_write` is called before and after each write
  /// (for tests of a death there).
  explicit CallRecord(std::filesystem::path file, std::function<void()> around_write = {});

  /// The file is there and cannot be read: nothing is known of the process before this one, and owners tell the epoch.
  bool damaged() const { return damaged_; }
  /// The newest epoch of the processes before this one; 0: there was none.
  std::uint64_t epoch() const { return epoch_; }
  /// The command to a subsystem that is under way.
  const std::optional<services::commander::Issued>& open() const { return open_; }
  /// The command from above that is under way.
  const std::optional<RunRecord>& run() const { return run_; }
  /// The state in which it rests; nothing: it has carried nothing out so far.
  const std::optional<temporal::Value>& state() const { return state_; }

  void begin_run(const services::owner::Request& request, temporal::Time now);
  void begin(const services::commander::Issued& issued);
  /// The call is over, and the next one begins now, if there is one.
  /// Of a run that takes more than kTaken nothing is known any more.
  void take(method_run::Taken taken, temporal::Time now);
  void break_off(const services::owner::CommandStatus& why);
  /// What is open stays so.
  void end_run(const temporal::Value& state);
  /// What was open is not.
  void end();

 private:
  void read(const std::string& text);
  void write();

  std::filesystem::path file_;
  std::function<void()> around_write_;
  bool damaged_ = false;
  std::uint64_t epoch_ = 0;
  std::optional<services::commander::Issued> open_;
  std::optional<RunRecord> run_;
  std::optional<temporal::Value> state_;
};

}  // namespace roci::dedicated
