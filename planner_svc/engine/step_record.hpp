// The record of an engine that plans all the time: how it was made, and step by step what it heard and what came of it.
// What such an engine puts out is a function of what it has heard since it was made, so each of its steps can be made
// again from the record, without the service.
//
//   bytes  what
//   8      "ROCISTEP"
//   1      version of the format
//   …      entries; the first one says how the engine was made, each further one is a step's inputs or its outcome
//
// of which each is
//
//   1      kind: 'E' engine, 'I' inputs, 'O' outcome of the inputs before
//   4      bytes of the body, little-endian
//   …      body: CBOR (RFC 8949), a map with the fields of step_fields.hpp by their names; times in microseconds,
//          enumerators as numbers, texts as the bytes that they are
//   8      FNV-1a, 64 bits, of kind, length and body, little-endian
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "planner_svc/engine/stepped_engine.hpp"

namespace roci::planner::engine {

inline constexpr unsigned char kStepRecordFormat = 1;
inline constexpr std::string_view kStepRecordMagic = "ROCISTEP";

/// Says in what(): "at byte 17: what is wrong".
class StepRecordError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Says how the engine of a record was made.
struct RecordedEngine {
  std::string engine;  ///< its name in the table
  std::string robot;
  std::vector<std::string> resolvers;
  std::string model;  ///< SteppedEngine::model(), before its first step
  friend bool operator==(const RecordedEngine&, const RecordedEngine&) = default;
};

/// Is what came of a step, as far as two runs of it are compared.
struct StepOutcome {
  std::string account;        ///< account_text(); empty: the step had nothing to do
  std::uint32_t version = 0;  ///< that was made; 0: none
  std::uint64_t delta = 0;    ///< checksum of the change of the plan, with all its fields
  std::string fault;          ///< what the engine threw
  friend bool operator==(const StepOutcome&, const StepOutcome&) = default;
};

/// Returns "part, part; 12 explored; version 3; note" of what a step did; empty for one that had nothing to do.
std::string account_text(const StepOutput& output);

/// Returns what came of a step that put this out, or threw `fault`.
StepOutcome outcome_of(const StepOutput& output, std::string fault = {});

/// Returns the beginning of a record.
std::string record_head(const RecordedEngine& engine);
/// Returns the entry that is to be appended to it.
std::string record_entry(const StepInputs& inputs);
std::string record_entry(const StepOutcome& outcome);

/// Holds one step as it was recorded: what the engine heard, and what came of it.
struct RecordedStep {
  StepInputs inputs;
  std::optional<StepOutcome> outcome{};  ///< nothing: the process ended in this step
};

/// Reads a record step by step. All of it throws StepRecordError for what is no record of this format.
class StepRecordReader {
 public:
  /// `bytes` outlive this.
  explicit StepRecordReader(std::string_view bytes);

  const RecordedEngine& engine() const { return engine_; }
  /// Returns the next step, or nothing at the end.
  std::optional<RecordedStep> next();
  /// Whether the last entry was being written when the process ended. It is passed over.
  bool cut_short() const { return cut_short_; }

 private:
  struct Entry {
    char kind = 0;
    std::string_view body{};
    std::size_t bytes = 0;
  };
  [[noreturn]] void fail(const std::string& what) const;
  std::optional<Entry> peek();
  template <class T>
  T take(const Entry& entry);

  std::string_view bytes_;
  std::size_t at_ = 0;
  bool cut_short_ = false;
  RecordedEngine engine_;
};

}  // namespace roci::planner::engine
