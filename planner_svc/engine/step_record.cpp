#include "planner_svc/engine/step_record.hpp"

#include <nlohmann/json.hpp>
#include <utility>

#include "core/bytes/fnv_1a.hpp"
#include "core/bytes/little_endian.hpp"
#include "planner_svc/engine/step_fields.hpp"

namespace roci::planner::engine {
namespace {

constexpr char kEngine = 'E';
constexpr char kInputs = 'I';
constexpr char kOutcome = 'O';
constexpr std::size_t kEntryHead = 5;
constexpr std::size_t kChecksum = 8;

template <class T>
std::string bytes_of(const T& value) {
  std::string out;
  nlohmann::json::to_cbor(nlohmann::json(value), out);
  return out;
}

template <class T>
std::string entry_of(char kind, const T& value) {
  const std::string body = bytes_of(value);
  std::string out(1, kind);
  bytes::append_little_endian(out, body.size(), kEntryHead - 1);
  out += body;
  bytes::append_little_endian(out, bytes::fnv_1a(out), kChecksum);
  return out;
}

}  // namespace

std::string account_text(const StepOutput& output) {
  const StepAccount& account = output.account;
  if (account.empty()) return "";
  std::string text;
  for (const std::string& part : account.parts) text += (text.empty() ? "" : ", ") + part;
  text += (text.empty() ? "" : "; ") + std::to_string(account.explored) + " explored";
  if (output.delta) text += "; version " + std::to_string(output.delta->added.version);
  for (const std::string& note : account.notes) text += "; " + note;
  return text;
}

StepOutcome outcome_of(const StepOutput& output, std::string fault) {
  StepOutcome out{.account = account_text(output), .version = 0, .delta = 0, .fault = std::move(fault)};
  if (output.delta) {
    out.version = output.delta->added.version;
    out.delta = bytes::fnv_1a(bytes_of(*output.delta));
  }
  return out;
}

std::string record_head(const RecordedEngine& engine) {
  std::string out(kStepRecordMagic);
  out += static_cast<char>(kStepRecordFormat);
  return out + entry_of(kEngine, engine);
}

std::string record_entry(const StepInputs& inputs) { return entry_of(kInputs, inputs); }
std::string record_entry(const StepOutcome& outcome) { return entry_of(kOutcome, outcome); }

StepRecordReader::StepRecordReader(std::string_view bytes) : bytes_(bytes) {
  if (!bytes.starts_with(kStepRecordMagic))
    fail("no record of planning steps: it does not begin with '" + std::string(kStepRecordMagic) + "'");
  at_ = kStepRecordMagic.size();
  if (at_ == bytes.size()) fail("the bytes end before the version of the format");
  if (const auto format = static_cast<unsigned char>(bytes[at_]); format != kStepRecordFormat)
    fail("version " + std::to_string(format) + " of the format; version " +
         std::to_string(kStepRecordFormat) + " is read here, by a build like that which wrote the record");
  ++at_;
  const std::optional<Entry> first = peek();
  if (!first || first->kind != kEngine) fail("the record does not say how its engine was made");
  engine_ = take<RecordedEngine>(*first);
}

std::optional<RecordedStep> StepRecordReader::next() {
  const std::optional<Entry> inputs = peek();
  if (!inputs) return std::nullopt;
  if (inputs->kind != kInputs) fail("an entry that is no step's inputs where a step begins");
  RecordedStep out{.inputs = take<StepInputs>(*inputs)};
  const std::optional<Entry> outcome = peek();
  if (outcome && outcome->kind == kOutcome) out.outcome = take<StepOutcome>(*outcome);
  return out;
}

void StepRecordReader::fail(const std::string& what) const {
  throw StepRecordError("at byte " + std::to_string(at_) + ": " + what);
}

// Returns the entry that begins here, whole and as it was written.
std::optional<StepRecordReader::Entry> StepRecordReader::peek() {
  const std::string_view left = bytes_.substr(at_);
  if (left.empty()) return std::nullopt;
  cut_short_ = left.size() < kEntryHead;
  if (cut_short_) return std::nullopt;
  const std::size_t size = bytes::little_endian(left.substr(1, kEntryHead - 1));
  cut_short_ = left.size() - kEntryHead < size + kChecksum;
  if (cut_short_) return std::nullopt;
  const std::string_view whole = left.substr(0, kEntryHead + size);
  if (bytes::little_endian(left.substr(whole.size(), kChecksum)) != bytes::fnv_1a(whole))
    fail("the checksum of an entry is another: some of its bytes were changed");
  return Entry{left.front(), whole.substr(kEntryHead), whole.size() + kChecksum};
}

template <class T>
T StepRecordReader::take(const Entry& entry) {
  try {
    T out = nlohmann::json::from_cbor(entry.body).template get<T>();
    at_ += entry.bytes;
    return out;
  } catch (const std::exception& error) {
    fail(std::string("an entry that nobody wrote so: ") + error.what());
  }
}

}  // namespace roci::planner::engine
