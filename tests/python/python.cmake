# keyblock_python(NAME COMMAND...) runs a script with the Python that the module is for
set(python_path PYTHONPATH=${CMAKE_BINARY_DIR}/python)
function(keyblock_python name)
  add_test(NAME python/${name} COMMAND ${ARGN})
  set_tests_properties(python/${name} PROPERTIES TIMEOUT 300
    ENVIRONMENT "${python_path}")
endfunction()
set(python_tests ${CMAKE_CURRENT_SOURCE_DIR}/python)

foreach(case scene blocks limit program)
  keyblock_python(${case} ${PYTHON_OF_MODULE} ${python_tests}/geometry.py ${case}
    ${prm} $<TARGET_FILE:keyblock>)
endforeach()
foreach(case column by_hand factor several stop restart threads)
  keyblock_python(${case} ${PYTHON_OF_MODULE} ${python_tests}/runs.py ${case} ${prm}
    ${CMAKE_CURRENT_BINARY_DIR}/python_${case})
endforeach()
keyblock_python(files ${PYTHON_OF_MODULE} ${python_tests}/runs.py program ${prm}
  ${CMAKE_CURRENT_BINARY_DIR}/python_files $<TARGET_FILE:keyblock>)
foreach(ranks 1 2 4)
  keyblock_python(ranks.${ranks} mpirun --allow-run-as-root --oversubscribe -n ${ranks}
    ${PYTHON_OF_MODULE} ${python_tests}/runs.py ranks ${prm}
    ${CMAKE_CURRENT_BINARY_DIR}/python_ranks.${ranks})
  set_tests_properties(python/ranks.${ranks} PROPERTIES PROCESSORS ${ranks})
endforeach()
keyblock_python(stubs ${PYTHON_OF_MODULE} ${python_tests}/stubs.py
  ${CMAKE_SOURCE_DIR}/source/python/keyblock/__init__.pyi)

# its page in the manual; python3 there is the one that the module is for
get_filename_component(python_programs ${PYTHON_OF_MODULE} DIRECTORY)
add_test(NAME manual/python
  COMMAND ${PYTHON_OF_MODULE} ${CMAKE_CURRENT_SOURCE_DIR}/tutorial.py
    ${CMAKE_SOURCE_DIR}/doc/manual/python.md $<TARGET_FILE:keyblock>
    ${CMAKE_CURRENT_BINARY_DIR}/manual_python)
set_tests_properties(manual/python PROPERTIES TIMEOUT 300
  ENVIRONMENT "${python_path};PATH=${python_programs}:$ENV{PATH}")
