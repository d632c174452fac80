// A told error says that the fault was reported already: an entry that depends on the faulty one cannot be
// read either, which is no news.
#pragma once

#include "core/mission/entry.hpp"

namespace roci::mission {

/// Ends the reading of an entry. Where findings are collected (Entry::attempt) it is not noted.
class ToldError : public FileError {
 public:
  using FileError::FileError;
};

}  // namespace roci::mission
