// The drill: the same as ../../drill/drill_service.cpp, on the wire alone.
#pragma once

#include <optional>
#include <string>

#include "clock.hpp"
#include "commands.hpp"
#include "function.h"

namespace borehole {

class Drill final : private Driver {
 public:
  Drill(Clock&, const Options&);

 private:
  void answer(const v1::FunctionRequest&);
  v1::FunctionValues values(const v1::FunctionRequest&, const v1::FunctionBatch&) const;
  void carry_out(const CommandKey&, const v1::Command&) override;
  void break_off(const CommandKey&, const CommandStatus& why) override;
  void bored();
  void rest(const CommandStatus& last);
  void report(const std::string& timeline, const std::string& state);
  void wake();

  Clock& clock_;
  const Options options_;
  Output& offers_;
  Output& replies_;
  Output& observations_;
  Commands commands_;
  std::optional<CommandKey> running_;
  std::optional<std::int64_t> due_us_ = 0;  // of its one timer; first it says that it is idle
  std::string place_;
  bool hard_ = false;
};

}  // namespace borehole
