// The trace of a run has one line per plan, command, acknowledgement and observation, with its simulated
// time. Two runs are the same run when their traces are.
#pragma once

#include <memory>
#include <string>
#include <string_view>

namespace roci::exec::journal {

/// Computes the SHA-256 over the lines of a trace as they come.
class Trace {
 public:
  Trace();
  ~Trace();
  void add(std::string_view line);
  std::string sha256() const;  ///< of the lines up to now, each ended by a line feed; 64 hexadecimal digits

 private:
  struct Digest;
  std::unique_ptr<Digest> digest_;
};

}  // namespace roci::exec::journal
