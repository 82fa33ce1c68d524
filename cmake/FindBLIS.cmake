# Finds BLIS and its CBLAS header: the target BLIS::BLIS. The single-threaded build is preferred
# (Debian's libblis-serial-dev).
find_library(BLIS_LIBRARY NAMES blis PATH_SUFFIXES blis-serial blis-pthread blis-openmp)
find_path(BLIS_INCLUDE_DIR NAMES cblas.h PATH_SUFFIXES blis-serial blis-pthread blis-openmp)
mark_as_advanced(BLIS_LIBRARY BLIS_INCLUDE_DIR)

include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(BLIS REQUIRED_VARS BLIS_LIBRARY BLIS_INCLUDE_DIR)

if(BLIS_FOUND AND NOT TARGET BLIS::BLIS)
  add_library(BLIS::BLIS UNKNOWN IMPORTED)
  set_target_properties(BLIS::BLIS PROPERTIES IMPORTED_LOCATION ${BLIS_LIBRARY}
                                              INTERFACE_INCLUDE_DIRECTORIES ${BLIS_INCLUDE_DIR})
endif()
