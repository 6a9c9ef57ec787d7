# Installs a build, runs the program that it put there, and builds and runs a
# project that uses its library.
# usage: cmake -DBUILD=FOLDER -DFOLDER=FOLDER -DPROJECT=FOLDER [-DPYTHON=FILE]
#   -P install.cmake       PYTHON: that of the module, if it is built
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE code
    OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(code)
    message(FATAL_ERROR "${ARGN}\n${output}")
  endif()
  set(output "${output}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${FOLDER})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${FOLDER}/usr)
run(${FOLDER}/usr/bin/keyblock-report --help)
# scripts find what they share: they tell their arguments, or what is not there
foreach(script blocks_stl factor_uncertainty figures plot_geostress render view)
  execute_process(COMMAND ${FOLDER}/usr/share/keyblock/contrib/${script}.py --help
    RESULT_VARIABLE code OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(NOT output MATCHES "usage: |cannot be loaded" OR output MATCHES "No module named 'report|No module named 'script_tools")
    message(FATAL_ERROR "${script}.py\n${output}")
  endif()
endforeach()
run(${FOLDER}/usr/bin/keyblock --help)
# every option stands in the manual page
file(READ ${FOLDER}/usr/share/man/man1/keyblock.1 manual)
string(REGEX MATCHALL "--[a-z-]+" options "${output}")
foreach(option ${options})
  string(REPLACE "-" "\\-" written ${option})
  string(FIND "${manual}" "${written}" place)
  if(place LESS 0)
    message(FATAL_ERROR "${option} is not in keyblock.1")
  endif()
endforeach()
foreach(file bash-completion/completions/keyblock keyblock/summary.schema.json
    keyblock/study.schema.json)
  if(NOT EXISTS ${FOLDER}/usr/share/${file})
    message(FATAL_ERROR "share/${file} is missing")
  endif()
endforeach()
if(PYTHON)
  file(GLOB folder ${FOLDER}/usr/lib/python3*/dist-packages)
  run(${CMAKE_COMMAND} -E env PYTHONPATH=${folder} ${PYTHON} -c
    "print(__import__('keyblock').Scene('${FOLDER}/usr/share/keyblock/prm/tutorial/sliding_block.prm'))")
  if(NOT output MATCHES "sliding_block.prm', 2D")
    message(FATAL_ERROR "${output}")
  endif()
endif()
run(${CMAKE_COMMAND} -S ${PROJECT} -B ${FOLDER}/user
  -DCMAKE_PREFIX_PATH=${FOLDER}/usr -DCMAKE_BUILD_TYPE=Release)
run(${CMAKE_COMMAND} --build ${FOLDER}/user)
run(${FOLDER}/user/user
  ${FOLDER}/usr/share/keyblock/prm/tutorial/sliding_block.prm)
if(NOT output MATCHES "dimension 2\n")
  message(FATAL_ERROR "${output}")
endif()
