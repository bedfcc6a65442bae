# The engine: no OpenGL, no window, prints nothing.
include(GNUInstallDirs)
find_package(tomlplusplus REQUIRED)
find_path(EIGEN_INCLUDE_DIR Eigen/Core PATH_SUFFIXES eigen3 REQUIRED)
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(MUPARSER_LIBRARY muparser REQUIRED)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial)
find_library(HDF5_HL_LIBRARY NAMES hdf5_serial_hl hdf5_hl REQUIRED)

# the page of exported runs, embedded
set(embedded_page ${PROJECT_BINARY_DIR}/generated/embedded_page.cpp)
set(page_parts ${PROJECT_SOURCE_DIR}/engine/export/page.html
  ${PROJECT_SOURCE_DIR}/engine/export/embed_page.cmake)
add_custom_command(OUTPUT ${embedded_page}
  COMMAND ${CMAKE_COMMAND} -DPAGE=${PROJECT_SOURCE_DIR}/engine/export/page.html
          -DOUTPUT=${embedded_page} -P ${PROJECT_SOURCE_DIR}/engine/export/embed_page.cmake
  DEPENDS ${page_parts} VERBATIM)

file(GLOB_RECURSE ENGINE_SOURCES CONFIGURE_DEPENDS engine/*.cpp engine/*.h)
add_library(gridshell_engine STATIC ${ENGINE_SOURCES} ${embedded_page})
add_library(gridshell::gridshell ALIAS gridshell_engine)
set_target_properties(gridshell_engine PROPERTIES EXPORT_NAME gridshell)
target_compile_features(gridshell_engine PUBLIC cxx_std_20)
target_include_directories(gridshell_engine PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gridshell>)
target_include_directories(gridshell_engine SYSTEM PUBLIC ${EIGEN_INCLUDE_DIR})
target_include_directories(gridshell_engine SYSTEM PRIVATE ${CHOLMOD_INCLUDE_DIR})
target_compile_definitions(gridshell_engine PUBLIC EIGEN_DONT_PARALLELIZE)
target_link_libraries(gridshell_engine PUBLIC fmt::fmt
  PRIVATE tomlplusplus::tomlplusplus ${CHOLMOD_LIBRARY} ${MUPARSER_LIBRARY} ${HDF5_HL_LIBRARY} PkgConfig::HDF5)
# the two hot loops may contract a*b+c; everything else rounds each operation
set_source_files_properties(engine/solve/block_cholesky.cpp engine/gridshell/assembly.cpp
  PROPERTIES COMPILE_OPTIONS -ffp-contract=fast SKIP_PRECOMPILE_HEADERS ON)
# tests/faults stands between the linear solver and all that asks for it
set_source_files_properties(engine/solve/linear_solver.cpp PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
gridshell_position_independent(gridshell_engine)
gridshell_read_once(gridshell_engine)
gridshell_compile_by_folder(gridshell_engine)
