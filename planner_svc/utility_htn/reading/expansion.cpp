#include "planner_svc/utility_htn/reading/expansion.hpp"

#include "core/words/nearest_word.hpp"
#include "planner_svc/utility_htn/model/bounds.hpp"

namespace roci::planner::utility_htn::reading {

namespace {

constexpr std::size_t kMost = 2 * model::kMostTasks;

}  // namespace

std::vector<std::string> Expansion::values(const Source& source) {
  if (source.entry().is_sequence()) {
    std::vector<std::string> out;
    for (const Source& item : source.items()) out.push_back(item.text());
    return out;
  }
  if (source.entry().is_mapping()) {
    source.entry().allow_only({"from", "to"});
    const std::uint64_t from = source.at("from").count(kMost), to = source.at("to").count(kMost);
    if (to < from) source.fail("it ends before it begins; exchange 'from' and 'to'");
    std::vector<std::string> out;
    for (std::uint64_t value = from; value <= to; ++value) out.push_back(std::to_string(value));
    return out;
  }
  const std::string name = source.text();
  if (const auto found = sets_.find(name); found != sets_.end()) return found->second;
  std::vector<std::string> known;
  for (const auto& [set, members] : sets_) known.push_back(set);
  unknown_->fail({"set", name, "no set '" + name + "'",
                  "list the values, or name them under 'sets'" + words::did_you_mean(name, known)},
                 source);
}

std::vector<Bindings> Expansion::combinations(const Source& repeated) {
  std::vector<Bindings> out;
  if (repeated.entry().is_sequence()) {  // rows
    for (const Source& row : repeated.items()) {
      Bindings& bindings = out.emplace_back();
      for (const auto& [word, value] : row.fields()) bindings[word] = value.text();
    }
    return out;
  }
  out.emplace_back();
  for (const auto& [word, set] : repeated.fields()) {
    const std::vector<std::string> members = values(set);
    if (members.size() * out.size() > kMost)
      repeated.fail("more than " + std::to_string(kMost) + " repetitions; make the lists shorter");
    std::vector<Bindings> longer;
    for (const Bindings& begun : out) {
      for (const std::string& member : members) {
        longer.push_back(begun);
        longer.back()[word] = member;
      }
    }
    out = std::move(longer);
  }
  return out;
}

void Expansion::spend(const Source& list, std::size_t items) {
  items_ += items;
  if (items_ > model::kMostItems)
    stop(list, "more than " + std::to_string(model::kMostItems) +
                   " items in the lists of all tasks; make the network smaller");
}

void Expansion::stop_at_many_findings() const {
  if (findings_->errors() >= kMostFindings) throw ReadingAborted();
}

void Expansion::stop(const Source& at, const std::string& what) {
  findings_->add(at.entry().place() + ": " + what);
  throw ReadingAborted();
}

void Expansion::repeat(const Source& value, const std::function<void(const Source&)>& read) {
  stop_at_many_findings();
  const auto repeated = value.entry().is_mapping() ? value.find("for") : std::nullopt;
  if (!repeated) return read(value);
  const std::vector<Bindings> all = combinations(*repeated);
  repetitions_ += all.size();
  if (repetitions_ > kMost)
    stop(*repeated,
         "more than " + std::to_string(kMost) + " repetitions in one file; make the lists shorter");
  const auto faults = [this] { return findings_->errors() + unknown_->failures(); };
  const std::size_t before = faults();
  for (const Bindings& bindings : all) {
    if (faults() > before) return;
    read(value.with(bindings));
  }
}

void Expansion::each_field(const Source& mapping, const Read& read) {
  for (const auto& [raw, value] : mapping.raw_fields()) {
    value.entry().attempt([&, &key = raw, &source = value] {
      repeat(source, [&](const Source& one) { read(one.filled(key), one); });
    });
  }
}

void Expansion::each_item(const Source& list, const std::function<void(const Source&)>& read) {
  for (const Source& item : list.items()) item.entry().attempt([&] { repeat(item, read); });
}

}  // namespace roci::planner::utility_htn::reading
