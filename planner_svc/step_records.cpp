#include "planner_svc/step_records.hpp"

#include <charconv>
#include <system_error>

namespace roci::planner {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view kSteps = ".steps";

// The number of a record, or 0 for any other file.
int number_of(const fs::path& file) {
  const std::string name = file.filename().string();
  int number = 0;
  const auto [end, fault] = std::from_chars(name.data(), name.data() + name.size(), number);
  return fault == std::errc() && end == name.data() + name.size() - kSteps.size() && name.ends_with(kSteps)
             ? number
             : 0;
}

std::uintmax_t size_of(const fs::path& file) {
  std::error_code error;
  const std::uintmax_t bytes = fs::file_size(file, error);
  return error ? 0 : bytes;
}

}  // namespace

StepRecords::StepRecords(fs::path folder) : StepRecords(std::move(folder), Bounds{}) {}

StepRecords::StepRecords(fs::path folder, const Bounds& bounds)
    : folder_(std::move(folder)), bounds_(bounds) {}

void StepRecords::begin(const engine::RecordedEngine& engine) {
  if (folder_.empty()) return;
  out_.close();
  std::error_code ignored;
  fs::create_directories(folder_, ignored);
  if (!std::exchange(looked_, true)) look_through_folder();
  const int number = records_.empty() ? 1 : records_.rbegin()->first + 1;
  const fs::path file = folder_ / (std::to_string(number) + std::string(kSteps));
  records_.emplace(number, file);
  remove_old();
  out_.clear();
  out_.open(file, std::ios::binary);
  written_ = 0;
  write(engine::record_head(engine));
}

void StepRecords::heard(const engine::StepInputs& inputs) {
  if (out_.is_open()) write(engine::record_entry(inputs));
}

void StepRecords::did(const engine::StepOutcome& outcome) {
  if (out_.is_open()) write(engine::record_entry(outcome));
}

std::string StepRecords::take_end() { return std::exchange(ended_, {}); }

// What earlier engines and processes of the planner left there.
void StepRecords::look_through_folder() {
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder_, error); !error && entry != fs::directory_iterator();
       entry.increment(error))
    if (const int number = number_of(entry->path()); number > 0) records_.emplace(number, entry->path());
}

// The one that begins has room for all that it may hold.
void StepRecords::remove_old() {
  std::uintmax_t together = bounds_.bytes;
  for (const auto& [number, file] : records_) together += size_of(file);
  std::error_code ignored;
  while (records_.size() > 1 && (records_.size() > bounds_.records || together > bounds_.together)) {
    together -= size_of(records_.begin()->second);
    fs::remove(records_.begin()->second, ignored);
    records_.erase(records_.begin());
  }
}

// An entry is whole or the last one; after one that is not whole nothing could be read.
void StepRecords::write(const std::string& bytes) {
  if (written_ + bytes.size() > bounds_.bytes)
    return end("it has reached " + std::to_string(bounds_.bytes) + " bytes");
  written_ += bytes.size();
  if (!(out_ << bytes).flush()) end("it cannot be written");
}

void StepRecords::end(std::string why) {
  out_.close();
  ended_ = records_.rbegin()->second.filename().string() + " ends here: " + std::move(why);
}

}  // namespace roci::planner
