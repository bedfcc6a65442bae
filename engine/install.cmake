# cmake --install: the library with its headers for find_package(gridshell) and pkg-config, the
# presets and, where it is built, the program with its manual page and completion.
include(CMakePackageConfigHelpers)

install(TARGETS gridshell_engine EXPORT gridshell-targets)
install(DIRECTORY engine/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/gridshell/engine
  FILES_MATCHING PATTERN "*.h")
install(DIRECTORY presets/ DESTINATION ${CMAKE_INSTALL_DATADIR}/gridshell/presets
  FILES_MATCHING PATTERN "*.toml" PATTERN "*.obj" PATTERN "*.csv" PATTERN "*.json"
    PATTERN "*.dxf" PATTERN "pictures" EXCLUDE)
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

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
  install(TARGETS gridshell)
  # both say what the program says of itself
  set(manual ${PROJECT_BINARY_DIR}/generated/gridshell.1)
  set(completion ${PROJECT_BINARY_DIR}/generated/gridshell.bash)
  add_custom_command(OUTPUT ${manual} ${completion}
    COMMAND gridshell list --man > ${manual}
    COMMAND gridshell list --completion bash > ${completion}
    DEPENDS gridshell VERBATIM)
  add_custom_target(manual ALL DEPENDS ${manual} ${completion})
  install(FILES ${manual} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${completion} RENAME gridshell
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
endif()
