# The programs. The library gridshell_app contains the commands, so that tests can use them; gridshell is
# main.cpp with it. The library gridshell_view contains the window; gridshell_window has both. `gridshell
# view` starts gridshell_window, so that users who only make movies need not wait for the window to be
# compiled.
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
set(VIEW_SOURCES ${APP_SOURCES})
list(FILTER APP_SOURCES EXCLUDE REGEX "/app/(cli/main\\.cpp$|examples/|python/|window/)")
list(FILTER VIEW_SOURCES INCLUDE REGEX "/app/window/")
list(FILTER VIEW_SOURCES EXCLUDE REGEX "/main\\.cpp$")
add_library(gridshell_app STATIC ${APP_SOURCES} ${embedded_presets} ${embedded_cards})
target_link_libraries(gridshell_app PUBLIC gridshell_engine gridshell_render
  PRIVATE CLI11::CLI11 nlohmann_json::nlohmann_json Threads::Threads)
target_include_directories(gridshell_app SYSTEM PUBLIC ${GL_CORE_INCLUDE_DIR})
gridshell_position_independent(gridshell_app)
gridshell_compile_lightly(gridshell_app)
# headers that most of its files include
gridshell_read_once(gridshell_app ${PROJECT_SOURCE_DIR}/engine/gridshell.h
  ${PROJECT_SOURCE_DIR}/engine/core/json.h)
gridshell_in_batches(gridshell_app 8)

add_executable(gridshell app/cli/main.cpp)
target_link_libraries(gridshell PRIVATE gridshell_app)

add_library(gridshell_view STATIC ${VIEW_SOURCES})
target_link_libraries(gridshell_view PUBLIC gridshell_app
  PRIVATE nlohmann_json::nlohmann_json PkgConfig::IMGUI PkgConfig::FONTCONFIG)
gridshell_position_independent(gridshell_view)
gridshell_compile_lightly(gridshell_view)
gridshell_read_once(gridshell_view gridshell_app)
gridshell_in_batches(gridshell_view 8)

add_executable(gridshell_window app/window/main.cpp)
target_link_libraries(gridshell_window PRIVATE gridshell_view)
