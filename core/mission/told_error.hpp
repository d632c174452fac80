// What is wrong has been told already: the entry that stands on it cannot be read either, which is no news.
#pragma once

#include "core/mission/entry.hpp"

namespace roci::mission {

/// Ends the reading of an entry. Where findings are collected (Entry::attempt) it is not noted.
class ToldError : public FileError {
 public:
  using FileError::FileError;
};

}  // namespace roci::mission
