#pragma once

#include <dlfcn.h>

namespace roci::contract {

/// Returns the function of this name that a library loaded before a process stands in front of.
template <class Function>
Function* next(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace roci::contract
