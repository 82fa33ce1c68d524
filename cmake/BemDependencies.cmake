find_package(Threads REQUIRED)
find_package(Eigen3 3.4 REQUIRED NO_MODULE)
find_package(TBB REQUIRED)
find_package(assimp REQUIRED)
find_package(CLI11 REQUIRED)
find_package(nlohmann_json 3.11 REQUIRED)
find_package(HDF5 REQUIRED COMPONENTS C)
# Headers only, for the triangulation of polygons: nothing of it is linked.
find_path(CGAL_INCLUDE_DIR CGAL/Constrained_Delaunay_triangulation_2.h REQUIRED)
mark_as_advanced(CGAL_INCLUDE_DIR)
find_package(PkgConfig REQUIRED)
pkg_check_modules(HWY REQUIRED IMPORTED_TARGET libhwy)
pkg_check_modules(FFTW REQUIRED IMPORTED_TARGET fftw3)
pkg_check_modules(XXHASH REQUIRED IMPORTED_TARGET libxxhash)

# BLIS in its single-threaded build: the project's own tiles supply the parallelism, so that
# results do not depend on the number of threads (docs/performance.md compares the choices).
find_package(BLIS REQUIRED)
