# The Python module: the package keyblock in python/ of the build folder.
# Python and NumPy are those of the system, whose packages pybind11 and NumPy are
# there, whatever other Python stands first in PATH.
find_program(PYTHON_OF_MODULE python3 PATHS /usr/bin NO_DEFAULT_PATH
  DOC "Python that the module is for; with NumPy")
execute_process(COMMAND ${PYTHON_OF_MODULE} -c
  "import numpy, sysconfig; print(sysconfig.get_path('include'), sysconfig.get_config_var('EXT_SUFFIX'), sysconfig.get_config_var('py_version_short'), sep=';')"
  OUTPUT_VARIABLE python OUTPUT_STRIP_TRAILING_WHITESPACE RESULT_VARIABLE code)
if(code)
  message(FATAL_ERROR "${PYTHON_OF_MODULE} has no NumPy; install python3-numpy, name another one by -DPYTHON_OF_MODULE=..., or set -DPYTHON_MODULE=OFF.")
endif()
list(GET python 0 python_headers)
list(GET python 1 python_suffix)
list(GET python 2 python_version)
if(NOT EXISTS ${python_headers}/Python.h)
  message(FATAL_ERROR "There is no ${python_headers}/Python.h; install python3-dev, or set -DPYTHON_MODULE=OFF.")
endif()
set(PYBIND11_NOPYTHON ON)
find_package(pybind11 2.9 REQUIRED)

make_room(python
  any_scene.cc
  any_blocks.cc
  any_joint_points.cc
  any_run.cc
  process.cc
  bind_scene.cc
  bind_blocks.cc
  bind_joint_points.cc
  bind_run.cc
  module.cc
)
target_include_directories(room_python SYSTEM PRIVATE ${python_headers})
target_link_libraries(room_python pybind11::headers)
# (pybind11 hides its symbols, so that modules by several versions get along)
target_compile_options(room_python PRIVATE -fvisibility=hidden)
compile_quickly(room_python)

# The library's code can stand anywhere in memory as deal.II's flags have it, and
# the loops over cells as the compilers of Debian and Ubuntu do (-fPIE): the program
# is the same with and without the module.
set(python_folder ${CMAKE_BINARY_DIR}/python/keyblock)
add_library(python_module MODULE $<TARGET_OBJECTS:room_python>)
target_link_libraries(python_module keyblock_library)
deal_ii_setup_target(python_module)
set_target_properties(python_module PROPERTIES PREFIX "" OUTPUT_NAME _core
  SUFFIX ${python_suffix} LIBRARY_OUTPUT_DIRECTORY ${python_folder})
# of the library only what the module calls is seen from outside
target_link_options(python_module PRIVATE -Wl,--exclude-libs,libkeyblock.a)
foreach(file __init__.py __init__.pyi sweeps.py py.typed)
  configure_file(${CMAKE_CURRENT_SOURCE_DIR}/python/keyblock/${file}
    ${python_folder}/${file} COPYONLY)
endforeach()

set(PYTHON_VERSION_OF_MODULE ${python_version} CACHE INTERNAL "")
set(PYTHON_INSTALL_FOLDER lib/python${python_version}/dist-packages CACHE STRING
  "Where the package keyblock is installed, below the prefix")
install(DIRECTORY ${python_folder} DESTINATION ${PYTHON_INSTALL_FOLDER}
  COMPONENT program PATTERN "__pycache__" EXCLUDE)
install(FILES ${CMAKE_SOURCE_DIR}/contrib/python/first_tunnel.py
  DESTINATION ${CMAKE_INSTALL_DATADIR}/keyblock/python COMPONENT program)
