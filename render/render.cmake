# The renderer. OpenGL is loaded at run time, so only its headers are needed to build. Of the engine
# the renderer includes only core/, preset/ and record/.
find_package(PNG REQUIRED)
pkg_check_modules(DEFLATE REQUIRED IMPORTED_TARGET libdeflate)
pkg_check_modules(PANGOCAIRO REQUIRED IMPORTED_TARGET pangocairo)
find_path(GL_CORE_INCLUDE_DIR GL/glcorearb.h REQUIRED)
find_path(OSMESA_INCLUDE_DIR GL/osmesa.h REQUIRED)
find_path(EGL_INCLUDE_DIR EGL/egl.h REQUIRED)
find_path(GLFW_INCLUDE_DIR GLFW/glfw3.h REQUIRED)

# the shaders become strings of the program
file(GLOB SHADER_FILES CONFIGURE_DEPENDS shaders/*.vert shaders/*.frag shaders/*.glsl)
set(SHADER_TEXT ${PROJECT_BINARY_DIR}/generated/shader_text.cpp)
add_custom_command(
  OUTPUT ${SHADER_TEXT}
  COMMAND ${CMAKE_COMMAND} -D FOLDER=${PROJECT_SOURCE_DIR}/shaders -D OUTPUT=${SHADER_TEXT}
          -P ${PROJECT_SOURCE_DIR}/render/gl/embed_shaders.cmake
  DEPENDS ${SHADER_FILES} render/gl/embed_shaders.cmake
  COMMENT "Embedding the shaders" VERBATIM)

# only render/gl, which processes pixels, is compiled at the full optimisation level
file(GLOB_RECURSE render_sources CONFIGURE_DEPENDS render/gl/*.cpp render/*.h)
file(GLOB_RECURSE light_sources CONFIGURE_DEPENDS render/canvas/*.cpp render/movie/*.cpp)
add_library(gridshell_render_light OBJECT ${light_sources})
add_library(gridshell_render STATIC ${render_sources} ${SHADER_TEXT}
  $<TARGET_OBJECTS:gridshell_render_light>)
foreach(part gridshell_render_light gridshell_render)
  target_include_directories(${part} SYSTEM PRIVATE ${GL_CORE_INCLUDE_DIR} ${OSMESA_INCLUDE_DIR}
    ${EGL_INCLUDE_DIR} ${GLFW_INCLUDE_DIR})
  target_link_libraries(${part} PUBLIC gridshell_engine
    PRIVATE PNG::PNG PkgConfig::DEFLATE PkgConfig::PANGOCAIRO ${CMAKE_DL_LIBS})
  gridshell_position_independent(${part})
endforeach()
gridshell_compile_lightly(gridshell_render_light)
gridshell_read_once(gridshell_render gridshell_version)
gridshell_read_once(gridshell_render_light gridshell_page)
gridshell_in_batches(gridshell_render 3)
gridshell_in_batches(gridshell_render_light 8)
