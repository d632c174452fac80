// This file lists the fields of the executive's messages for the archive, each type once, for writing and
// reading.
#pragma once

#include "exec_svc/archive/archive.hpp"
#include "exec_svc/executive/messages.hpp"

namespace roci::exec::executive {

template <class A>
void fields(A& a, archive::Of<Observation, A>& v) {
  a(v.timeline, v.value);
}
template <class A>
void fields(A& a, archive::Of<CommandResults, A>& v) {
  a(v.duration, v.energy_j, v.values);
}
template <class A>
void fields(A& a, archive::Of<CommandAck, A>& v) {
  a(v.activity, v.attempt, v.stage, v.code, v.reason, v.epoch, v.refused_epoch, v.results);
}

template <class A>
void fields(A& a, archive::Of<AnswerResult, A>& v) {
  a(v.outcome, v.reason);
}
template <class A>
void fields(A& a, archive::Of<DecisionStatus, A>& v) {
  a(v.decision, v.resolver, v.choices, v.admissible, v.answer_before, v.state, v.chosen, v.answered_by);
}

}  // namespace roci::exec::executive
