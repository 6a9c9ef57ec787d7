# keyblock_python(NAME LABEL RANKS COMMAND...) runs a script with the Python that the
# module is for
set(python_path PYTHONPATH=${CMAKE_BINARY_DIR}/python)
function(keyblock_python name label ranks)
  keyblock_test(python/${name} ${label} RANKS ${ranks} ENVIRONMENT "${python_path}"
    COMMAND ${ARGN})
endfunction()
set(python_tests ${CMAKE_CURRENT_SOURCE_DIR}/python)

foreach(case scene blocks limit program)
  keyblock_python(${case} quick 1 ${PYTHON_OF_MODULE} ${python_tests}/geometry.py ${case}
    ${prm} ${keyblock})
endforeach()
foreach(case column by_hand factor several stop restart threads)
  keyblock_python(${case} quick 1 ${PYTHON_OF_MODULE} ${python_tests}/runs.py ${case} ${prm}
    ${out}/python_${case})
endforeach()
keyblock_python(files quick 1 ${PYTHON_OF_MODULE} ${python_tests}/runs.py program ${prm}
  ${out}/python_files ${keyblock})
foreach(case "1 nightly" "2 ranks" "4 nightly")
  string(REGEX MATCH "(.*) (.*)" case ${case})
  keyblock_python(ranks.${CMAKE_MATCH_1} ${CMAKE_MATCH_2} ${CMAKE_MATCH_1}
    ${mpirun} ${CMAKE_MATCH_1} ${PYTHON_OF_MODULE} ${python_tests}/runs.py ranks ${prm}
    ${out}/python_ranks.${CMAKE_MATCH_1})
endforeach()
keyblock_python(stubs quick 1 ${PYTHON_OF_MODULE} ${python_tests}/stubs.py
  ${CMAKE_SOURCE_DIR}/source/python/keyblock/__init__.pyi)

# its page in the manual; python3 there is the one that the module is for
get_filename_component(python_programs ${PYTHON_OF_MODULE} DIRECTORY)
keyblock_test(manual/python tools
  COMMAND ${PYTHON_OF_MODULE} ${CMAKE_CURRENT_SOURCE_DIR}/tutorial.py
    ${CMAKE_SOURCE_DIR}/doc/manual/python.md ${keyblock} ${out}/manual_python
  ENVIRONMENT "${python_path}" "PATH=${python_programs}:$ENV{PATH}")
