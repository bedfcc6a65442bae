# cmake --install: the library with its headers for find_package(gridshell) and pkg-config, the
# presets and, where it is built, the program with its manual page and completion.
include(CMakePackageConfigHelpers)

# what is installed is built first where it was not
add_custom_target(installed)
add_dependencies(installed gridshell_engine)
install(CODE "execute_process(COMMAND ${CMAKE_COMMAND} --build ${PROJECT_BINARY_DIR} --target installed
  OUTPUT_QUIET COMMAND_ERROR_IS_FATAL ANY)")

install(TARGETS gridshell_engine EXPORT gridshell-targets)
install(DIRECTORY engine/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gridshell/engine
  FILES_MATCHING PATTERN "*.h")
install(DIRECTORY presets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/gridshell/presets
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.obj" PATTERN "*.csv" PATTERN "*.json"
    PATTERN "*.dxf" PATTERN "pictures" EXCLUDE)
install(FILES LICENSE README.md CHANGELOG.md CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
# the manual, with what its pages point to
file(GLOB_RECURSE pages RELATIVE ${PROJECT_SOURCE_DIR} CONFIGURE_DEPENDS app/*.md engine/*.md
  presets/*.md render/*.md presets/pictures/*.png presets/pictures/*.svg app/python/examples/*.py)
foreach(page IN LISTS pages ITEMS tests/images/window/push.png tests/images/window/states.png
    tests/images/window/design.png)
  get_filename_component(folder ${page} DIRECTORY)
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_DOCDIR}/${folder})
endforeach()

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/gridshell)
install(EXPORT gridshell-targets NAMESPACE gridshell:: DESTINATION ${package})
configure_package_config_file(engine/gridshell-config.cmake.in
  ${PROJECT_BINARY_DIR}/generated/gridshell-config.cmake INSTALL_DESTINATION ${package}
  PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/generated/gridshell-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/generated/gridshell-config.cmake
  ${PROJECT_BINARY_DIR}/generated/gridshell-config-version.cmake DESTINATION ${package})

# wherever the prefix is moved to
file(RELATIVE_PATH to_prefix /${CMAKE_INSTALL_LIBDIR}/pkgconfig /)
configure_file(engine/gridshell.pc.in ${PROJECT_BINARY_DIR}/generated/gridshell.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/generated/gridshell.pc
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

if(TARGET gridshell)
  install(TARGETS gridshell gridshell_window)
  # both say what the program says of itself
  set(manual ${PROJECT_BINARY_DIR}/generated/gridshell.1)
  set(completion ${PROJECT_BINARY_DIR}/generated/gridshell.bash)
  add_custom_command(OUTPUT ${manual} ${completion}
    COMMAND gridshell_window list --man > ${manual}
    COMMAND gridshell list --completion bash > ${completion}
    DEPENDS gridshell gridshell_window VERBATIM)
  add_custom_target(manual ALL DEPENDS ${manual} ${completion})
  add_dependencies(installed gridshell gridshell_window manual)
  install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${completion} RENAME gridshell
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endif()

if(TARGET gridshell_python)
  add_dependencies(installed gridshell_python)
  # where the Python of the prefix looks: of /usr and /usr/local one of its own folders
  install(CODE "
    execute_process(COMMAND ${Python3_EXECUTABLE} ${PROJECT_SOURCE_DIR}/app/python/folder.py
      \${CMAKE_INSTALL_PREFIX} OUTPUT_VARIABLE python_folder OUTPUT_STRIP_TRAILING_WHITESPACE
      COMMAND_ERROR_IS_FATAL ANY)")
  install(TARGETS gridshell_python DESTINATION "\${python_folder}")
  install(FILES ${PROJECT_BINARY_DIR}/python/gridshell.pyi DESTINATION "\${python_folder}")
endif()

# cpack --config build/CPackConfig.cmake: a Debian package of all this.
if(PROJECT_IS_TOP_LEVEL)
  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME gridshell)
  set(CPACK_PACKAGE_VENDOR "the authors of gridshell")
  set(CPACK_PACKAGE_CONTACT "the authors of gridshell <gridshell@localhost>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Forms, pokes, measures and shows elastic gridshells")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SECTION science)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  # OpenGL is looked for at run time
  set(CPACK_DEBIAN_PACKAGE_DEPENDS "libegl1, libgl1-mesa-dri, fonts-dejavu-extra")
  set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "ffmpeg, libosmesa6, libglfw3")
  # what whoever compiles against the library needs
  set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libfmt-dev, libeigen3-dev, libexpected-dev, \
libsuitesparse-dev, libmuparser-dev, libdeflate-dev, libhdf5-dev, libtomlplusplus-dev")
  if(TARGET gridshell_python)
    # a module is of one minor version of Python
    set(python ${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR})
    math(EXPR next "${Python3_VERSION_MINOR} + 1")
    string(APPEND CPACK_DEBIAN_PACKAGE_DEPENDS
      ", python3 (>= ${python}), python3 (<< ${Python3_VERSION_MAJOR}.${next}), python3-numpy")
  endif()
  include(CPack)
endif()
