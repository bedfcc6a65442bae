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

# code that computes for long is in core, elastic, footprint, geometry and solve, but for solvers that
# only studies use and what computes every frame; the other folders call it
file(GLOB_RECURSE engine_sources CONFIGURE_DEPENDS engine/*.cpp engine/*.h)
set(light_sources ${engine_sources})
list(FILTER light_sources INCLUDE REGEX "/(design|formats|preset|record|scene|simulate|study)/")
list(FILTER light_sources EXCLUDE REGEX
  "cholmod_solver|mountain_pass|multilevel_relaxation|contacts|frames_between|frame_forces|shape_measures")
list(REMOVE_ITEM engine_sources ${light_sources} ${PROJECT_SOURCE_DIR}/engine/core/version.cpp)

# two small files make the precompiled headers of both kinds, so that nothing else waits for long
add_library(gridshell_version OBJECT engine/core/version.cpp)
add_library(gridshell_page OBJECT ${embedded_page})
add_library(gridshell_engine_light OBJECT ${light_sources})
add_library(gridshell_engine STATIC ${engine_sources} $<TARGET_OBJECTS:gridshell_version>
  $<TARGET_OBJECTS:gridshell_page> $<TARGET_OBJECTS:gridshell_engine_light>)
add_library(gridshell::gridshell ALIAS gridshell_engine)
set_target_properties(gridshell_engine PROPERTIES EXPORT_NAME gridshell)
foreach(part gridshell_version gridshell_page gridshell_engine_light gridshell_engine)
  target_compile_features(${part} PUBLIC cxx_std_20)
  target_include_directories(${part} PUBLIC $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>
    $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/gridshell>)
  target_include_directories(${part} SYSTEM PUBLIC ${EIGEN_INCLUDE_DIR})
  target_compile_definitions(${part} PUBLIC EIGEN_DONT_PARALLELIZE)
  target_link_libraries(${part} PUBLIC fmt::fmt)
  gridshell_position_independent(${part})
endforeach()
foreach(part gridshell_engine_light gridshell_engine)
  target_include_directories(${part} SYSTEM PRIVATE ${SPECTRA_INCLUDE_DIR} ${CHOLMOD_INCLUDE_DIR})
  target_link_libraries(${part} PRIVATE tomlplusplus::tomlplusplus ${CHOLMOD_LIBRARY}
    ${MUPARSER_LIBRARY} ${DEFLATE_LIBRARY} ${HDF5_HL_LIBRARY} PkgConfig::HDF5)
endforeach()
gridshell_compile_lightly(gridshell_page)
gridshell_compile_lightly(gridshell_engine_light)
gridshell_read_once(gridshell_version ${read_by_all})
gridshell_read_once(gridshell_page ${read_by_all})
gridshell_read_once(gridshell_engine gridshell_version)
gridshell_read_once(gridshell_engine_light gridshell_page)
# the two hot loops may contract a*b+c; everything else rounds each operation
set_source_files_properties(engine/solve/block_factor.cpp engine/elastic/assembly.cpp
  PROPERTIES COMPILE_OPTIONS -ffp-contract=fast SKIP_PRECOMPILE_HEADERS ON)
gridshell_in_batches(gridshell_engine_light 6)
gridshell_in_batches(gridshell_engine 3)
