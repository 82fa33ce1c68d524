# Installs the build folder BUILD into TREE, without what an earlier version has left there.
file(REMOVE_RECURSE ${TREE})
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BUILD} --prefix ${TREE} COMMAND_ERROR_IS_FATAL ANY
                OUTPUT_QUIET)
