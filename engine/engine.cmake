# The engine: no OpenGL, no window, prints nothing.
include(GNUInstallDirs)
find_package(tomlplusplus REQUIRED)
find_path(EIGEN_INCLUDE_DIR Eigen/Core PATH_SUFFIXES eigen3 REQUIRED)
find_path(SPECTRA_INCLUDE_DIR Spectra/SymEigsSolver.h REQUIRED)
find_path(CHOLMOD_INCLUDE_DIR cholmod.h PATH_SUFFIXES suitesparse REQUIRED)
find_library(CHOLMOD_LIBRARY cholmod REQUIRED)
find_library(MUPARSER_LIBRARY muparser REQUIRED)
find_library(DEFLATE_LIBRARY deflate REQUIRED)
pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial)
find_library(HDF5_HL_LIBRARY NAMES hdf5_serial_hl hdf5_hl REQUIRED)

# the page of exported runs, embedded
set(embedded_page ${PROJECT_BINARY_DIR}/generated/embedded_page.cpp)
set(page_parts ${PROJECT_SOURCE_DIR}/engine/record/page.html
  ${PROJECT_SOURCE_DIR}/engine/record/embed_page.cmake)
add_custom_command(OUTPUT ${embedded_page}
  COMMAND ${CMAKE_COMMAND} -DPAGE=${PROJECT_SOURCE_DIR}/engine/record/page.html
          -DOUTPUT=${embedded_page} -P ${PROJECT_SOURCE_DIR}/engine/record/embed_page.cmake
  DEPENDS ${page_parts} VERBATIM)

add_library(gridshell_version OBJECT engine/core/version.cpp)
target_compile_features(gridshell_version PUBLIC cxx_std_20)
target_include_directories(gridshell_version PRIVATE ${PROJECT_SOURCE_DIR})
target_include_directories(gridshell_version SYSTEM PRIVATE ${EIGEN_INCLUDE_DIR})
target_compile_definitions(gridshell_version PRIVATE EIGEN_DONT_PARALLELIZE)
target_link_libraries(gridshell_version PRIVATE fmt::fmt)
gridshell_position_independent(gridshell_version)
target_precompile_headers(gridshell_version PRIVATE ${read_by_all})

file(GLOB_RECURSE ENGINE_SOURCES CONFIGURE_DEPENDS engine/*.cpp engine/*.h)
list(FILTER ENGINE_SOURCES EXCLUDE REGEX "/core/version\\.cpp$")
add_library(gridshell_engine STATIC ${ENGINE_SOURCES} ${embedded_page}
  $<TARGET_OBJECTS:gridshell_version>)
add_library(gridshell::gridshell ALIAS gridshell_engine)
set_target_properties(gridshell_engine PROPERTIES EXPORT_NAME gridshell)
target_compile_features(gridshell_engine PUBLIC cxx_std_20)
target_include_directories(gridshell_engine PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
  $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gridshell>)
target_include_directories(gridshell_engine SYSTEM PUBLIC ${EIGEN_INCLUDE_DIR})
target_include_directories(gridshell_engine SYSTEM PRIVATE ${SPECTRA_INCLUDE_DIR}
  ${CHOLMOD_INCLUDE_DIR})
target_compile_definitions(gridshell_engine PUBLIC EIGEN_DONT_PARALLELIZE)
target_link_libraries(gridshell_engine PUBLIC fmt::fmt
  PRIVATE tomlplusplus::tomlplusplus ${CHOLMOD_LIBRARY} ${MUPARSER_LIBRARY} ${DEFLATE_LIBRARY}
  ${HDF5_HL_LIBRARY} PkgConfig::HDF5)
# the two hot loops may contract a*b+c; everything else rounds each operation
set_source_files_properties(engine/solve/block_factor.cpp engine/elastic/assembly.cpp
  PROPERTIES COMPILE_OPTIONS -ffp-contract=fast SKIP_PRECOMPILE_HEADERS ON)
# what computes for long lies in geometry, footprint, elastic, solve and design; the rest asks it,
file(GLOB light CONFIGURE_DEPENDS engine/formats/*.cpp engine/preset/*.cpp
  engine/record/*.cpp engine/scene/*.cpp engine/simulate/*.cpp engine/study/*.cpp)
# but for what every frame has
list(FILTER light EXCLUDE REGEX "contacts|frames_between|frame_forces|shape_measures")
set_property(SOURCE ${light} ${embedded_page} APPEND PROPERTY
  COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
gridshell_position_independent(gridshell_engine)
gridshell_read_once(gridshell_engine)
