# CBC, the solver of integer programs, as the target roci_cbc: its library and those whose classes are used directly, without the
# command line of CBC (libCbcSolver) and what that brings.
include_guard(GLOBAL)
find_path(CBC_INCLUDE_DIR CbcModel.hpp PATH_SUFFIXES coin REQUIRED)
add_library(roci_cbc INTERFACE)
target_include_directories(roci_cbc SYSTEM INTERFACE "${CBC_INCLUDE_DIR}")
foreach(library Cbc Cgl OsiClp Osi CoinUtils)
  find_library(CBC_${library}_LIBRARY ${library} REQUIRED)
  target_link_libraries(roci_cbc INTERFACE "${CBC_${library}_LIBRARY}")
endforeach()
mark_as_advanced(CBC_INCLUDE_DIR)
