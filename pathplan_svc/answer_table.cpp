#include "pathplan_svc/answer_table.hpp"

namespace roci::pathplan {
namespace {

auto key_of(terrain::Point from, terrain::Point to) {
  return std::pair{std::pair{from.x, from.y}, std::pair{to.x, to.y}};
}

}  // namespace

const KeptAnswer* AnswerTable::find(terrain::Point from, terrain::Point to) {
  const auto found = answers_.find(key_of(from, to));
  if (found == answers_.end()) return nullptr;
  found->second.round = round_;
  return &found->second;
}

const KeptAnswer& AnswerTable::put(terrain::Point from, terrain::Point to, KeptAnswer answer) {
  if (answers_.size() >= kMost) answers_.clear();
  answer.round = round_;
  return answers_.insert_or_assign(key_of(from, to), std::move(answer)).first->second;
}

void AnswerTable::keep_unread(const ReadSet& changed) {
  std::erase_if(answers_, [&](const auto& entry) {
    const KeptAnswer& answer = entry.second;
    return answer.outcome.status != PathStatus::found || answer.reads.meets(changed);
  });
}

void AnswerTable::forget_unasked() {
  std::erase_if(answers_, [this](const auto& entry) { return entry.second.round < round_; });
  ++round_;
}

}  // namespace roci::pathplan
