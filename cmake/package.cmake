# The Debian packages liblampionVERSION, liblampion-dev, liblampion-doc, python3-lampion and lampion, made by `cpack`.
# Nothing in them depends on where or when they are made: SOURCE_DATE_EPOCH is the time of every file.
if(CPACK_TEMPORARY_INSTALL_DIRECTORY) # read again by cpack, before it makes archives of what it has installed
  execute_process(COMMAND find ${CPACK_TEMPORARY_INSTALL_DIRECTORY} -exec touch -h -d @$ENV{SOURCE_DATE_EPOCH} {} +
    COMMAND_ERROR_IS_FATAL ANY)
  return()
endif()
if(NOT DEFINED ENV{SOURCE_DATE_EPOCH})
  message(FATAL_ERROR "SOURCE_DATE_EPOCH is not set: run ./dev package")
endif()
string(TIMESTAMP date "%a, %d %b %Y %H:%M:%S +0000" UTC)
set(soname ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(release 1)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME lampion)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The Lampion authors <maintainers@users.noreply.h-seed-d5c2f71a.example>")
set(CPACK_PACKAGING_INSTALL_PREFIX ${CMAKE_INSTALL_PREFIX})
set(CPACK_STRIP_FILES ON)
set(CPACK_PRE_BUILD_SCRIPTS ${CMAKE_CURRENT_LIST_FILE})
set(CPACK_COMPONENTS_ALL library development documentation python tools)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PACKAGE_RELEASE ${release})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_COMPRESSION_TYPE xz)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(about "Lampion lights 3D scenes with glowing spheres, in real time, through\nspherical harmonics: \
the coefficients of a spherical cap have a closed\nrecurrence, so nothing is sampled and every light may move.")

set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME liblampion${soname})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_LIBRARY_DESCRIPTION
  "${about}\n\nThis is the shared library.")

set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME liblampion-dev)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS
  "liblampion${soname} (= ${PROJECT_VERSION}-${release}), libc6-dev")
set(CPACK_DEBIAN_DEVELOPMENT_DESCRIPTION
  "${about}\n\nThese are the headers, the \
static library, lampion.glsl and examples.")

set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_NAME liblampion-doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_SECTION doc)
set(CPACK_DEBIAN_DOCUMENTATION_PACKAGE_ARCHITECTURE all)
set(CPACK_DEBIAN_DOCUMENTATION_DESCRIPTION
  "${about}\n\nThese are its pages and the descriptions of its functions, as a site to read \
without a network.")

set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-lampion)
set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
# what cffi has generated needs its backend alone; structures have the layout of the version that was declared
set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS
  "liblampion${soname} (>= ${PROJECT_VERSION}), python3:any, python3-cffi-backend, python3-numpy")
set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS lampion)
set(CPACK_DEBIAN_PYTHON_DESCRIPTION
  "${about}\n\nThese are the library's functions for Python, on NumPy's arrays.")

set(CPACK_DEBIAN_TOOLS_PACKAGE_NAME lampion)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_TOOLS_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_TOOLS_PACKAGE_DEPENDS "libassimp5, libegl1, libgl1, libgl1-mesa-dri, libglfw3") # opened while running
set(CPACK_DEBIAN_TOOLS_DESCRIPTION
  "${about}\n\nThis is the program, which renders \
glTF and OBJ scenes with or without a GPU.")

# The documents need pandoc.
set(documents ${PROJECT_BINARY_DIR}/documents)
file(GLOB pages CONFIGURE_DEPENDS *.md docs/*.md docs/site/* include/lampion/*.h)
add_custom_command(OUTPUT ${documents}/lampion-formats.5.gz
  COMMAND docs/site/build.sh ${documents}/html
  COMMAND docs/site/formats.sh ${documents}/lampion-formats.5
  COMMAND gzip -9nf ${documents}/lampion-formats.5
  DEPENDS ${pages} WORKING_DIRECTORY ${PROJECT_SOURCE_DIR} COMMENT "Making the documents" VERBATIM)
add_custom_target(lampion_documents ALL DEPENDS ${documents}/lampion-formats.5.gz)
install(DIRECTORY ${documents}/html DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/liblampion-doc
  COMPONENT documentation)
install(FILES ${documents}/lampion-formats.5.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man5
  COMPONENT tools)

# Debian requires these of every package.
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/triggers)
file(WRITE ${PROJECT_BINARY_DIR}/debian/triggers "activate-noawait ldconfig\n")
file(WRITE ${PROJECT_BINARY_DIR}/debian/changelog.Debian
  "lampion (${PROJECT_VERSION}-${release}) unstable; urgency=medium\n\n  * Version ${PROJECT_VERSION}.\n\n \
-- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/debian/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)
# Python compiles its modules when they are installed, and forgets what it compiled when they go, as Debian's packages
# have it; in a folder that is not the system's (DPKG_ROOT) there is nothing that would run them.
file(WRITE ${PROJECT_BINARY_DIR}/debian/postinst "#!/bin/sh\nset -e\nif [ \"$1\" = configure ] && [ -z \"$DPKG_ROOT\" ] && \
command -v py3compile >/dev/null; then\n    py3compile -p python3-lampion\nfi\n")
file(WRITE ${PROJECT_BINARY_DIR}/debian/prerm "#!/bin/sh\nset -e\nif [ -z \"$DPKG_ROOT\" ] && \
command -v py3clean >/dev/null; then\n    py3clean -p python3-lampion\nfi\n")
set(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/debian/postinst ${PROJECT_BINARY_DIR}/debian/prerm)

foreach(component IN ITEMS library development documentation python tools)
  string(TOUPPER ${component} upper)
  set(folder ${CMAKE_INSTALL_DATADIR}/doc/${CPACK_DEBIAN_${upper}_PACKAGE_NAME})
  install(FILES LICENSE DESTINATION ${folder} RENAME copyright COMPONENT ${component})
  install(FILES ${PROJECT_BINARY_DIR}/debian/changelog.Debian.gz DESTINATION ${folder}
    COMPONENT ${component})
endforeach()
include(CPack)
