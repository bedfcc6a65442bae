# The fuzz targets: with GRIDSHELL_FUZZ (the CMake preset `fuzz`, which needs clang) a program with
# libFuzzer for each; otherwise tests over the saved corpus.
#   cmake --preset fuzz && cmake --build --preset fuzz
#   build-fuzz/fuzz_preset -max_total_time=300 corpus tests/fuzz/corpus/preset
file(GLOB fuzz_sources CONFIGURE_DEPENDS tests/fuzz/*.cpp tests/fuzz/*.h)
list(FILTER fuzz_sources EXCLUDE REGEX "/(libfuzzer|test_replay)\\.cpp$")

if(GRIDSHELL_FUZZ)
  # the sources that read files, and no more of the engine
  find_package(tomlplusplus REQUIRED)
  find_package(nlohmann_json REQUIRED)
  pkg_check_modules(HDF5 REQUIRED IMPORTED_TARGET hdf5-serial)
  find_library(HDF5_HL_LIBRARY NAMES hdf5_serial_hl hdf5_hl REQUIRED)
  find_path(EIGEN_INCLUDE_DIR Eigen/Core PATH_SUFFIXES eigen3 REQUIRED)
  find_library(MUPARSER_LIBRARY muparser REQUIRED)
  find_package(PNG REQUIRED)
  find_package(ZLIB REQUIRED)
  pkg_check_modules(DEFLATE REQUIRED IMPORTED_TARGET libdeflate)
  file(GLOB reading CONFIGURE_DEPENDS engine/core/*.cpp engine/formats/*.cpp engine/preset/*.cpp
    engine/record/*.cpp engine/footprint/network.cpp engine/footprint/footprint.cpp engine/footprint/network_grid.cpp engine/geometry/surface.cpp engine/geometry/triangle_*.cpp)
  add_library(fuzzed STATIC ${reading} render/gl/image.cpp ${fuzz_sources})
  target_include_directories(fuzzed PUBLIC ${PROJECT_SOURCE_DIR})
  target_include_directories(fuzzed SYSTEM PUBLIC ${EIGEN_INCLUDE_DIR})
  target_compile_options(fuzzed PUBLIC -fsanitize=fuzzer-no-link,address,undefined -g -O1)
  target_link_libraries(fuzzed PUBLIC fmt::fmt tomlplusplus::tomlplusplus ${HDF5_HL_LIBRARY}
    PkgConfig::HDF5 PkgConfig::DEFLATE ${MUPARSER_LIBRARY} nlohmann_json::nlohmann_json PNG::PNG ZLIB::ZLIB)
  foreach(target preset points surface network cloud summary journal trajectory states sweep_log png)
    add_executable(fuzz_${target} tests/fuzz/libfuzzer.cpp)
    target_compile_definitions(fuzz_${target} PRIVATE GRIDSHELL_FUZZ_TARGET=${target})
    target_link_libraries(fuzz_${target} PRIVATE fuzzed)
    target_link_options(fuzz_${target} PRIVATE -fsanitize=fuzzer,address,undefined)
  endforeach()
elseif(GRIDSHELL_TESTS AND GRIDSHELL_PICTURES)
  add_executable(test_fuzz tests/fuzz/test_replay.cpp ${fuzz_sources})
  target_link_libraries(test_fuzz PRIVATE gridshell_render gridshell_engine PkgConfig::HDF5
    Catch2::Catch2WithMain)
  target_include_directories(test_fuzz SYSTEM PRIVATE ${catch_names})
  target_compile_definitions(test_fuzz PRIVATE GRIDSHELL_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  catch_discover_tests(test_fuzz ${catch_arguments}
    PROPERTIES LABELS quick TIMEOUT ${quick_seconds})
endif()
