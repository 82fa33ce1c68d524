# cmake --install: the library with its headers, a package for find_package(bem), scripts, manual pages, completion,
# documents and scenes. Each tool installs itself. The two components are those of the Debian packages.
include(CMakePackageConfigHelpers)
set(BEM_CMAKE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/bem)

install(TARGETS bem EXPORT bemTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT development)
# One header is for the library alone: it includes JSON for Modern C++, which users of the library need not have.
install(DIRECTORY libbem/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/bem COMPONENT development FILES_MATCHING PATTERN "*.hpp"
        PATTERN glb_container.hpp EXCLUDE)
install(EXPORT bemTargets NAMESPACE bem:: DESTINATION ${BEM_CMAKE_DIR} COMPONENT development)

configure_package_config_file(cmake/bemConfig.cmake.in ${PROJECT_BINARY_DIR}/bemConfig.cmake
                              INSTALL_DESTINATION ${BEM_CMAKE_DIR})
# before version 1.0 a minor version may break its users
write_basic_package_version_file(${PROJECT_BINARY_DIR}/bemConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/bemConfig.cmake ${PROJECT_BINARY_DIR}/bemConfigVersion.cmake
              cmake/FindBLIS.cmake
        DESTINATION ${BEM_CMAKE_DIR} COMPONENT development)

# Scripts that need no source tree, and render.py as a program.
set(BEM_SCRIPTS ${CMAKE_INSTALL_DATADIR}/bem/scripts)
install(PROGRAMS scripts/render.py scripts/refine_mesh.py scripts/textured_mesh.py scripts/page_picture.py scripts/bunny_to_obj.py
                 scripts/fetch_meshes.sh
        DESTINATION ${BEM_SCRIPTS})
install(DIRECTORY scripts/rendering scripts/common DESTINATION ${BEM_SCRIPTS}
        FILES_MATCHING PATTERN "*.py" PATTERN __pycache__ EXCLUDE)
file(CREATE_LINK ../${BEM_SCRIPTS}/render.py ${PROJECT_BINARY_DIR}/bemrender SYMBOLIC)
install(PROGRAMS ${PROJECT_BINARY_DIR}/bemrender DESTINATION ${CMAKE_INSTALL_BINDIR})

foreach(program bemprecomp bemsim bemshape bemmeasure bemrecode bemview bemrender)
  install(FILES packaging/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME ${program})
endforeach()
# Debian's zsh looks for completions of packages in a folder of its own.
install(CODE "set(bem_zsh site-functions)
  if(CMAKE_INSTALL_PREFIX MATCHES \"/usr$\")
    set(bem_zsh vendor-completions)
  endif()")
install(FILES packaging/completion.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/\${bem_zsh} RENAME _bem)

# The links between the documents hold there as they do in the source tree.
install(FILES README.md CHANGELOG.md CONTRIBUTING.md CITATION.cff LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/bem)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/bem RENAME copyright)
install(DIRECTORY docs scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/bem)
include(BemManual)

add_custom_target(uninstall COMMAND ${CMAKE_COMMAND} -DMANIFEST=${PROJECT_BINARY_DIR}/install_manifest.txt
                                    -P ${PROJECT_SOURCE_DIR}/packaging/uninstall.cmake VERBATIM)
include(BemPackage)
