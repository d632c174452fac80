/// The fields of problems for the archive, each type once, for writing and reading.
#pragma once

#include "exec_svc/archive/archive.hpp"
#include "exec_svc/problem/problem_writer.hpp"

namespace roci::exec::problem {

template <class A>
void fields(A& a, archive::Of<ProblemObject, A>& v) {
  a(v.name, v.type, v.properties);
}
template <class A>
void fields(A& a, archive::Of<Problem, A>& v) {
  a(v.text, v.objects);
}

}  // namespace roci::exec::problem
