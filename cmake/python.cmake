# The Python package: its sources, and the module that cffi makes of the public headers. It is the same on every
# architecture, and opens the shared library while running.
find_program(LAMPION_PYTHON3 python3 PATHS /usr/bin NO_DEFAULT_PATH) # Debian's, which has Debian's modules
find_program(LAMPION_PYTHON3 python3 REQUIRED)
set(LAMPION_PYTHON_FOLDER lib/python3/dist-packages CACHE STRING "Where the Python package is installed")

file(GLOB python_sources CONFIGURE_DEPENDS python/lampion/*.py)
set(python_native ${PROJECT_BINARY_DIR}/python/_native.py)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/python)
add_custom_command(OUTPUT ${python_native}
  COMMAND ${CMAKE_COMMAND} -E env PYTHONDONTWRITEBYTECODE=1
          ${LAMPION_PYTHON3} python/generate.py include/lampion ${python_native}
  DEPENDS ${lampion_headers} python/generate.py WORKING_DIRECTORY ${PROJECT_SOURCE_DIR}
  COMMENT "Declaring the headers to Python" VERBATIM)
add_custom_target(lampion_python ALL DEPENDS ${python_native})
install(FILES ${python_sources} python/lampion/py.typed ${python_native}
  DESTINATION ${LAMPION_PYTHON_FOLDER}/lampion COMPONENT python)
