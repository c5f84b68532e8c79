# find_package(talus) brings the target talus::talus.
include(CMakeFindDependencyMacro)
find_dependency(Threads)
find_dependency(TBB)
find_dependency(Eigen3 3.4 NO_MODULE)
find_dependency(PkgConfig)
pkg_check_modules(CLP REQUIRED IMPORTED_TARGET clp)
include(${CMAKE_CURRENT_LIST_DIR}/talusTargets.cmake)
