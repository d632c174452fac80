#include "pathplan_svc/answer_table.hpp"

namespace roci::pathplan {
namespace {

auto key_of(terrain::Point from, terrain::Point to) {
  return std::pair{std::pair{from.x, from.y}, std::pair{to.x, to.y}};
}

}  // namespace

const KeptAnswer* AnswerTable::find(terrain::Point from, terrain::Point to) const {
  const auto found = answers_.find(key_of(from, to));
  return found == answers_.end() ? nullptr : &found->second;
}

const KeptAnswer& AnswerTable::put(terrain::Point from, terrain::Point to, KeptAnswer answer) {
  if (answers_.size() >= kMost) answers_.clear();
  return answers_.insert_or_assign(key_of(from, to), std::move(answer)).first->second;
}

void AnswerTable::keep_unread(const ReadSet& changed) {
  std::erase_if(answers_, [&](const auto& entry) {
    const KeptAnswer& answer = entry.second;
    return answer.outcome.status != PathStatus::found || answer.reads.meets(changed);
  });
}

}  // namespace roci::pathplan
