# The program: gridshell_app holds the commands (testable), gridshell is main.cpp over it.
find_package(CLI11 REQUIRED)
find_package(nlohmann_json REQUIRED)
find_package(Threads REQUIRED)
pkg_check_modules(IMGUI REQUIRED IMPORTED_TARGET imgui)
pkg_check_modules(FONTCONFIG REQUIRED IMPORTED_TARGET fontconfig)
find_path(GL_CORE_INCLUDE_DIR GL/glcorearb.h REQUIRED)

file(GLOB preset_files CONFIGURE_DEPENDS presets/*.toml)
file(GLOB named_files CONFIGURE_DEPENDS presets/*.obj presets/*.csv presets/*.json presets/*.dxf)
set(embedded_presets ${PROJECT_BINARY_DIR}/generated/embedded_presets.cpp)
add_custom_command(OUTPUT ${embedded_presets}
  COMMAND ${CMAKE_COMMAND} "-DPRESETS=${preset_files}" "-DFILES=${named_files}" -DOUTPUT=${embedded_presets}
          -P ${PROJECT_SOURCE_DIR}/app/cli/embed_presets.cmake
  DEPENDS ${preset_files} ${named_files} ${PROJECT_SOURCE_DIR}/app/cli/embed_presets.cmake VERBATIM)

file(GLOB card_files CONFIGURE_DEPENDS presets/pictures/cards/*.png)
set(embedded_cards ${PROJECT_BINARY_DIR}/generated/embedded_cards.cpp)
add_custom_command(OUTPUT ${embedded_cards}
  COMMAND ${CMAKE_COMMAND} "-DCARDS=${card_files}" -DOUTPUT=${embedded_cards}
          -P ${PROJECT_SOURCE_DIR}/app/cli/embed_cards.cmake
  DEPENDS ${card_files} ${PROJECT_SOURCE_DIR}/app/cli/embed_cards.cmake VERBATIM)

file(GLOB_RECURSE APP_SOURCES CONFIGURE_DEPENDS app/*.cpp app/*.h)
list(FILTER APP_SOURCES EXCLUDE REGEX "/app/(cli/main\\.cpp$|examples/|python/)")
add_library(gridshell_app STATIC ${APP_SOURCES} ${embedded_presets} ${embedded_cards})
target_link_libraries(gridshell_app PUBLIC gridshell_engine gridshell_render
  PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json Threads::Threads
          PkgConfig::IMGUI PkgConfig::FONTCONFIG)
target_include_directories(gridshell_app SYSTEM PRIVATE ${GL_CORE_INCLUDE_DIR})
gridshell_position_independent(gridshell_app)
gridshell_compile_lightly(gridshell_app)
# its files read the whole library
gridshell_read_once(gridshell_app ${read_by_all} ${PROJECT_SOURCE_DIR}/engine/gridshell.h
  ${PROJECT_SOURCE_DIR}/engine/core/json.h)
gridshell_in_batches(gridshell_app 8)

add_executable(gridshell app/cli/main.cpp)
target_link_libraries(gridshell PRIVATE gridshell_app)
