# OMPL as the target roci_ompl. Of the libraries that Debian's config lists only OMPL's own is linked: the list also
# names Boost archives that nothing here uses and that its package does not bring.
include_guard(GLOBAL)
find_package(ompl REQUIRED)
list(GET OMPL_LIBRARIES 0 ompl_library)
add_library(roci_ompl INTERFACE)
target_link_libraries(roci_ompl INTERFACE "${ompl_library}")
target_include_directories(roci_ompl SYSTEM INTERFACE ${OMPL_INCLUDE_DIRS})
