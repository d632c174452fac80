# `cpack` in the build folder makes a Debian package: what `cmake --install` writes, under /usr, with the packages that it needs.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_PACKAGE_CONTACT "Rocinante <rocinante@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "On-board autonomy for space robots, as separate processes that talk over DDS")
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# For who builds services with the SDK (docs/sdk.md).
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "g++, cmake, libfastcdr-dev, libfmt-dev, libyaml-cpp-dev, libssl-dev")
include(CPack)
