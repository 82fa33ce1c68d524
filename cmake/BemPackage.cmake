# Debian packages, with `cpack -G DEB` in the build folder: bem has the programs, libbem-dev the library.
set(CPACK_PACKAGE_CONTACT "the bem authors <bem@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "elastodynamics of deformable bodies from their surface alone")
set(CPACK_PACKAGE_VENDOR "the bem authors")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_COMPONENTS_ALL programs development)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)

set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION
    "Programs that simulate elastic bodies with a boundary element method:\n matrices of a mesh, scenes, trajectories, pages for the browser, pictures.")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME bem)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_DEPENDS libblis4-serial)  # not any of its builds, as the library itself would have it
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "python3 (>= 3.10), python3-numpy, python3-h5py, python3-pil, fonts-dejavu-core")
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "ffmpeg, bash-completion")

set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "The library of bem with its headers and a CMake package.")
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libbem-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
    "libeigen3-dev, libtbb-dev, libassimp-dev, libhdf5-dev, nlohmann-json3-dev, libhwy-dev, libfftw3-dev, libxxhash-dev, libblis-serial-dev, pkg-config")
set(CMAKE_SKIP_INSTALL_ALL_DEPENDENCY ON)  # packing does not build the tests
include(CPack)
