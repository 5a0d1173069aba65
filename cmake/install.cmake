# Installs library, headers, shaders and program, to be found through find_package(lampion) or pkg-config wherever the
# tree is moved. The components are the Debian packages: library, development, documentation, tools.
include(CMakePackageConfigHelpers)

install(TARGETS ${lampion_libraries} EXPORT lampionTargets
  ARCHIVE COMPONENT development
  LIBRARY COMPONENT library NAMELINK_COMPONENT development
  RUNTIME COMPONENT library)
set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME development)
install(FILES ${lampion_headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lampion)
include(variants)
install(FILES ruler/ruler.csv ruler/bands.csv DESTINATION ${CMAKE_INSTALL_DATADIR}/lampion/ruler)
install(DIRECTORY examples DESTINATION ${CMAKE_INSTALL_DOCDIR}
  PATTERN node_modules EXCLUDE PATTERN examples/three/shaders EXCLUDE PATTERN probe.json EXCLUDE)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/lampion)
install(EXPORT lampionTargets NAMESPACE lampion:: DESTINATION ${package_dir})
configure_package_config_file(cmake/lampionConfig.cmake.in
  ${PROJECT_BINARY_DIR}/lampionConfig.cmake INSTALL_DESTINATION ${package_dir})
# Before 1.0 a minor version may break callers.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/lampionConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/lampionConfig.cmake
  ${PROJECT_BINARY_DIR}/lampionConfigVersion.cmake DESTINATION ${package_dir})

cmake_path(RELATIVE_PATH CMAKE_INSTALL_PREFIX
  BASE_DIRECTORY ${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig OUTPUT_VARIABLE pc_prefix)
# A static library cannot state its own dependencies.
if(NOT BUILD_SHARED_LIBS AND NOT LAMPION_BOTH)
  set(pc_libs -lm)
endif()
configure_file(cmake/lampion.pc.in ${PROJECT_BINARY_DIR}/lampion.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/lampion.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

set(CMAKE_INSTALL_DEFAULT_COMPONENT_NAME tools)
if(LAMPION_PROGRAM)
  install(TARGETS lampion_program)
endif()
if(TARGET lampion_manual)
  install(DIRECTORY ${manual}/man/ DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${manual}/bash/lampion
    DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  set(zsh_folder site-functions)
  if(LAMPION_PACKAGE) # /usr/local's is site-functions
    set(zsh_folder vendor-completions)
  endif()
  install(FILES ${manual}/zsh/_lampion DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/${zsh_folder})
  install(FILES ${manual}/fish/lampion.fish
    DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
endif()
