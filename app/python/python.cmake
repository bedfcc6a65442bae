# The Python module `gridshell`, if pybind11 is installed.
# outside of a virtual environment it is built for the system's Python, which has the packages' numpy
if(NOT DEFINED ENV{VIRTUAL_ENV} AND EXISTS /usr/bin/python3)
  set(Python3_EXECUTABLE /usr/bin/python3 CACHE FILEPATH "of the Python module")
endif()
find_package(Python3 COMPONENTS Interpreter Development.Module QUIET)
find_package(pybind11 2.10 CONFIG QUIET)
if(NOT pybind11_FOUND OR NOT Python3_Development.Module_FOUND)
  message(STATUS "No Python module: it needs the packages pybind11-dev, python3-dev, python3-numpy")
  return()
endif()

file(GLOB python_sources CONFIGURE_DEPENDS app/python/*.cpp app/python/*.h)
pybind11_add_module(gridshell_python MODULE NO_EXTRAS ${python_sources})
# symbols of the static libraries in the module are not visible to other modules
target_link_options(gridshell_python PRIVATE LINKER:--exclude-libs,ALL)
target_link_libraries(gridshell_python PRIVATE gridshell_app gridshell_render gridshell_engine)
set_target_properties(gridshell_python PROPERTIES OUTPUT_NAME gridshell
  LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR}/python)
gridshell_compile_lightly(gridshell_python)
gridshell_read_once(gridshell_python gridshell_page)
gridshell_in_batches(gridshell_python 2)
# gridshell.pyi: the signatures of the module, for editors and type checkers
add_custom_command(TARGET gridshell_python POST_BUILD
  COMMAND ${Python3_EXECUTABLE} -B ${PROJECT_SOURCE_DIR}/app/python/stubs.py ${PROJECT_BINARY_DIR}/python
  BYPRODUCTS ${PROJECT_BINARY_DIR}/python/gridshell.pyi VERBATIM)
