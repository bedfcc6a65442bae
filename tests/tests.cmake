# Tests mirror the source: tests/engine -> test_engine, tests/render -> test_render, tests/app -> test_app.
# Their tags are CTest labels: untagged tests are `quick`, [standard] those that take over a second,
# [full] what a release needs in addition. tests/run.sh runs all but `full`.
# [shared] tests read all runs of build/shared_runs, [s1] tests that of s1_actuation; both are made before.
find_package(Catch2 QUIET)
if(NOT Catch2_FOUND)
  message(STATUS "No tests: they need the package catch2")
  return()
endif()
include(Catch)
find_package(nlohmann_json REQUIRED)
# the tests use the names of version 2, for which it is an error only on request that no test matches
set(catch_names "")
set(catch_arguments EXTRA_ARGS --warn NoTests)
if(Catch2_VERSION VERSION_GREATER_EQUAL 3)
  set(catch_names ${PROJECT_SOURCE_DIR}/tests/catch3)
  # version 3 exits with the number of failures, and 4 must not count as a skipped test
  set(catch_arguments SKIP_IS_FAILURE)
endif()

# the sanitizers of the debug presets take some ten times as long
set(quick_seconds 60)
if(CMAKE_BUILD_TYPE STREQUAL "Debug")
  set(quick_seconds 900)
endif()

# gridshell_tier(LABEL SPEC PROPERTIES...): registers the tests of `target` that match SPEC under that label
function(gridshell_tier label spec)
  string(MAKE_C_IDENTIFIER "${target}_${label}${spec}" list)
  catch_discover_tests(${target} TEST_SPEC ${spec} TEST_LIST ${list} ${catch_arguments}
    PROPERTIES LABELS ${label} ${ARGN})
endfunction()

# gridshell_tests(NAME LIBRARIES...): one test program of tests/NAME/**/test_*.cpp, if there are any
function(gridshell_tests folder)
  file(GLOB_RECURSE sources CONFIGURE_DEPENDS tests/${folder}/test_*.cpp)
  if(NOT sources)
    return()
  endif()
  file(GLOB_RECURSE helpers CONFIGURE_DEPENDS tests/${folder}/*.h)
  set(target test_${folder})
  add_executable(${target} ${sources} ${helpers})
  target_link_libraries(${target} PRIVATE ${ARGN} PkgConfig::HDF5 nlohmann_json::nlohmann_json
    Catch2::Catch2WithMain)
  target_include_directories(${target} SYSTEM PRIVATE ${CHOLMOD_INCLUDE_DIR} ${catch_names})
  target_compile_definitions(${target} PRIVATE GRIDSHELL_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  # the first test program makes the precompiled header of all
  if(folder STREQUAL engine)
    gridshell_read_once(${target} <catch2/catch.hpp> ${PROJECT_SOURCE_DIR}/engine/gridshell.h)
  else()
    gridshell_read_once(${target} test_engine)
  endif()
  gridshell_compile_lightly(${target})
  gridshell_in_batches(${target} 6)
  # a name that CMake tears apart (at a semicolon) must fail instead of matching no test
  gridshell_tier(quick "~[full]~[standard]~[alone]~[shared]~[s1]" TIMEOUT ${quick_seconds})
  gridshell_tier(standard "[standard]~[shared]~[s1]" TIMEOUT 600)
  gridshell_tier(full "[full]~[shared]~[s1]" TIMEOUT 1200)
  if(folder STREQUAL app)
    # those that look at a clock
    gridshell_tier(quick "~[full]~[standard][alone]~[shared]~[s1]" TIMEOUT ${quick_seconds}
      RUN_SERIAL ON)
    gridshell_tier(quick "[s1]" TIMEOUT ${quick_seconds} FIXTURES_REQUIRED shared_s1_actuation)
    gridshell_tier(standard "~[full][shared]~[s1]" TIMEOUT 600 FIXTURES_REQUIRED shared_runs)
    gridshell_tier(full "[full][shared]~[s1]" TIMEOUT 1200 FIXTURES_REQUIRED shared_runs)
  endif()
endfunction()

# Runs that many tests look at are made once, in build/shared_runs: each line of tests/images/list.txt, and
# the recorded visits of the window.
if(GRIDSHELL_PICTURES)
  set(list ${PROJECT_SOURCE_DIR}/tests/images/list.txt)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${list})
  file(STRINGS ${list} names REGEX "^[a-z].*:")
  list(TRANSFORM names REPLACE ":.*" "")
  foreach(name IN LISTS names ITEMS window)
    add_test(NAME "shared run: ${name}" COMMAND ${PROJECT_SOURCE_DIR}/tests/images/draw.sh
      $<TARGET_FILE:gridshell> ${PROJECT_BINARY_DIR}/shared_runs ${name})
    set_tests_properties("shared run: ${name}" PROPERTIES LABELS standard TIMEOUT 600
      FIXTURES_SETUP "shared_runs;shared_${name}")
  endforeach()
endif()

gridshell_tests(engine gridshell_engine)
# limits of the stability of methods: tests/stability -> test_stability
gridshell_tests(stability gridshell_engine)
# random scenes and judgements of their runs, shared with bench_trust: tests/bench -> test_bench
set(trust_study tests/bench/random_network.cpp tests/bench/random_scenes.cpp
  tests/bench/trust_study.cpp)
gridshell_tests(bench gridshell_engine)
if(TARGET test_bench)
  target_sources(test_bench PRIVATE ${trust_study})
endif()
if(GRIDSHELL_PICTURES)
  gridshell_tests(render gridshell_render gridshell_engine)
  # every call of the system fails once: `tests/faults` -> `test_faults`
  gridshell_tests(faults gridshell_view gridshell_app gridshell_render gridshell_engine ${CMAKE_DL_LIBS})
  if(TARGET test_faults)
    target_sources(test_faults PRIVATE tests/faults/faults.cpp)
    # solves fail as well: `faults.cpp` is between the engine and its linear solver
    target_link_options(test_faults PRIVATE
      "LINKER:--wrap=_ZN9gridshell18make_linear_solverERKNS_5ModelE")
  endif()
  gridshell_tests(app gridshell_view gridshell_app gridshell_render gridshell_engine)
  if(TARGET test_app)
    add_dependencies(test_app gridshell gridshell_window)
    target_compile_definitions(test_app PRIVATE GRIDSHELL_PROGRAM="$<TARGET_FILE:gridshell>"
      GRIDSHELL_SHARED_RUNS="${PROJECT_BINARY_DIR}/shared_runs" GRIDSHELL_IMGUI="${IMGUI_VERSION}"
      GRIDSHELL_BUILT_WITH="${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_BUILD_TYPE}")
    # the program with those clones of functions that are for the oldest processors (baseline_processor.cpp)
    if(CMAKE_SYSTEM_PROCESSOR STREQUAL "x86_64" AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
      add_executable(gridshell_baseline app/cli/main.cpp tests/app/baseline_processor.cpp)
      target_link_libraries(gridshell_baseline PRIVATE gridshell_app)
      add_dependencies(test_app gridshell_baseline)
      target_compile_definitions(test_app PRIVATE
        GRIDSHELL_BASELINE_PROGRAM="$<TARGET_FILE:gridshell_baseline>")
    endif()
  endif()
  # hostile inputs, damaged folders and signals, drawn: tests/attack -> test_attack; by hand
  # GRIDSHELL_TRIALS=1000 build/test_attack "[damage]" draws more, GRIDSHELL_SEED others.
  gridshell_tests(attack gridshell_view gridshell_app gridshell_render gridshell_engine)
  if(TARGET test_attack)
    target_sources(test_attack PRIVATE tests/attack/hostile_preset.cpp)
    add_dependencies(test_attack gridshell gridshell_window)
    # more trials than in every run of the tests
    foreach(kind damage presets signals)
      add_test(NAME "attacks: ${kind}" COMMAND test_attack "[${kind}]")
      set_tests_properties("attacks: ${kind}" PROPERTIES LABELS full TIMEOUT 1200
        ENVIRONMENT GRIDSHELL_TRIALS=60)
    endforeach()
    target_compile_definitions(test_attack PRIVATE GRIDSHELL_PROGRAM="$<TARGET_FILE:gridshell>")
  endif()
endif()

# The program on processors older and newer than this one, by qemu-user where it is installed.
if(GRIDSHELL_PICTURES)
  add_test(NAME "old and new processors run the program and give the same states"
    COMMAND ${PROJECT_SOURCE_DIR}/tests/processors.sh $<TARGET_FILE:gridshell>)
  set_tests_properties("old and new processors run the program and give the same states"
    PROPERTIES LABELS full TIMEOUT 600 SKIP_RETURN_CODE 77)
endif()

# The pictures of README and gallery, drawn again.
if(GRIDSHELL_PICTURES)
  set(drawn ${PROJECT_BINARY_DIR}/pictures)
  add_test(NAME "pictures of README and gallery are those of the program"
    COMMAND sh -c "rm -rf ${drawn} && TO=${drawn} ${PROJECT_SOURCE_DIR}/presets/pictures/draw.sh $<TARGET_FILE:gridshell> s1_actuation s2_indentation cards && $<TARGET_FILE:gridshell> compare ${drawn} ${PROJECT_SOURCE_DIR}/presets/pictures --selected")
  set_tests_properties("pictures of README and gallery are those of the program"
    PROPERTIES LABELS full TIMEOUT 3600)
endif()

# Shells against CalculiX where it is installed.
if(GRIDSHELL_PICTURES)
  add_test(NAME "CalculiX gives the same shells, displacements and frequencies"
    COMMAND python3 ${PROJECT_SOURCE_DIR}/tests/calculix.py $<TARGET_FILE:gridshell>)
  set_tests_properties("CalculiX gives the same shells, displacements and frequencies"
    PROPERTIES LABELS full TIMEOUT 900 SKIP_RETURN_CODE 77)
endif()

# The two commands of the README on a fresh Debian of either kind.
foreach(suite bookworm trixie)
  add_test(NAME "a fresh Debian: ${suite}" COMMAND ${PROJECT_SOURCE_DIR}/tests/fresh.sh ${suite})
  set_tests_properties("a fresh Debian: ${suite}" PROPERTIES LABELS full TIMEOUT 7200
    SKIP_RETURN_CODE 77 RUN_SERIAL ON)
endforeach()

# Style of the source and of the pages (tests/style.sh).
foreach(check format tidy clang warnings equal names pages words)
  add_test(NAME "style: ${check}" COMMAND ${PROJECT_SOURCE_DIR}/tests/style.sh ${check})
  set_tests_properties("style: ${check}" PROPERTIES LABELS style TIMEOUT 600 SKIP_RETURN_CODE 77
    ENVIRONMENT BUILD=${PROJECT_BINARY_DIR})
endforeach()
# it keeps all cores busy for minutes
set_tests_properties("style: tidy" PROPERTIES LABELS "style;full" RUN_SERIAL ON)
# only the four changed files with the most changed lines; `tests/style.sh clang` checks ten
set_tests_properties("style: clang" PROPERTIES ENVIRONMENT "BUILD=${PROJECT_BINARY_DIR};LIMIT=4")

# The manual: every code block of every page is run (tests/manual.sh).
if(GRIDSHELL_PICTURES)
  set(python python3)
  if(TARGET gridshell_python)
    set(python ${Python3_EXECUTABLE})
  endif()
  file(GLOB pages RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS README.md app/README.md
    app/manual/*.md app/python/README.md engine/*.md presets/README.md render/README.md)
  foreach(page IN LISTS pages)
    add_test(NAME "manual: ${page}"
      COMMAND ${PROJECT_SOURCE_DIR}/tests/manual.sh $<TARGET_FILE:gridshell> ${python} ${page})
    set_tests_properties("manual: ${page}" PROPERTIES LABELS quick TIMEOUT ${quick_seconds}
      ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python")
  endforeach()
endif()

# The programs of app/examples, 30 lines each over the library, run as tests.
file(GLOB examples CONFIGURE_DEPENDS app/examples/*.cpp)
foreach(source IN LISTS examples)
  get_filename_component(example ${source} NAME_WE)
  add_executable(example_${example} ${source})
  target_link_libraries(example_${example} PRIVATE gridshell::gridshell)
  gridshell_compile_lightly(example_${example})
  # a precompiled header is used only with the definitions that it was compiled with
  target_compile_definitions(example_${example} PRIVATE GRIDSHELL_SOURCE_DIR="${PROJECT_SOURCE_DIR}")
  gridshell_read_once(example_${example} test_engine)
  add_test(NAME "example: ${example}" COMMAND example_${example})
  set_tests_properties("example: ${example}" PROPERTIES LABELS quick TIMEOUT ${quick_seconds})
endforeach()
# installed into an empty prefix, another project finds library and presets
add_test(NAME "an installed library is found by CMake and pkg-config"
  COMMAND ${PROJECT_SOURCE_DIR}/tests/install.sh ${PROJECT_BINARY_DIR} ${CMAKE_CXX_COMPILER})
set_tests_properties("an installed library is found by CMake and pkg-config"
  PROPERTIES LABELS standard TIMEOUT 600)

# The Python module: tests/app/python, by pytest where it is installed.
if(TARGET gridshell_python)
  add_test(NAME "python module" COMMAND ${PROJECT_SOURCE_DIR}/tests/python.sh ${Python3_EXECUTABLE})
  set_tests_properties("python module" PROPERTIES LABELS quick TIMEOUT 300 SKIP_RETURN_CODE 77
    ENVIRONMENT "PYTHONPATH=${PROJECT_BINARY_DIR}/python;PYTHONDONTWRITEBYTECODE=1;GRIDSHELL_PROGRAM=$<TARGET_FILE:gridshell>")
endif()

# Benches are programs of their own, built on demand: `cmake --build build --target benches`.
add_custom_target(benches)
file(GLOB bench_sources CONFIGURE_DEPENDS tests/bench/bench_*.cpp)
foreach(source IN LISTS bench_sources)
  get_filename_component(bench ${source} NAME_WE)
  if(bench MATCHES "_(solver|trust)$")
    set(libraries gridshell_engine)
  elseif(GRIDSHELL_PICTURES)
    set(libraries gridshell_render gridshell_engine)
  else()
    continue()
  endif()
  add_executable(${bench} EXCLUDE_FROM_ALL ${source})
  target_link_libraries(${bench} PRIVATE ${libraries})
  if(bench STREQUAL "bench_trust")
    target_sources(bench_trust PRIVATE ${trust_study})
  endif()
  add_dependencies(benches ${bench})
endforeach()
