# Installs the build folder BUILD into TREE, without what an earlier version has left there. The list of what has been installed
# goes beside it, so that the user's own list, which `uninstall` reads, stays.
file(REMOVE_RECURSE ${TREE})
set(manifest ${BUILD}/install_manifest.txt)
if(EXISTS ${manifest})
  file(RENAME ${manifest} ${TREE}.kept)
endif()
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${TREE} COMMAND_ERROR_IS_FATAL ANY
                OUTPUT_QUIET)
file(RENAME ${manifest} ${TREE}.manifest)
if(EXISTS ${TREE}.kept)
  file(RENAME ${TREE}.kept ${manifest})
endif()
