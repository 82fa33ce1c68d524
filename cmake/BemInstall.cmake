# cmake --install: the library with its headers, and a package for find_package(bem). Each tool
# installs itself.
include(CMakePackageConfigHelpers)
set(BEM_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/bem)

install(TARGETS bem EXPORT bemTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
# One header is for the library alone: it includes JSON for Modern C++, which users of the library need not have.
install(DIRECTORY libbem/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/bem FILES_MATCHING PATTERN "*.hpp"
        PATTERN glb_container.hpp EXCLUDE)
install(EXPORT bemTargets NAMESPACE bem:: DESTINATION ${BEM_CMAKE_DIR})

configure_package_config_file(cmake/bemConfig.cmake.in ${PROJECT_BINARY_DIR}/bemConfig.cmake
                              INSTALL_DESTINATION ${BEM_CMAKE_DIR})
# before version 1.0 a minor version may break its users
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bemConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bemConfig.cmake ${PROJECT_BINARY_DIR}/bemConfigVersion.cmake
              cmake/FindBLIS.cmake
        DESTINATION ${BEM_CMAKE_DIR})
