# what VTU files hold: tensors, names, ids, shared points
foreach(case "column 2" "wedge 1" "stages 1" "bolts 1" "vtk 2")
  string(REGEX MATCH "(.*) (.*)" case ${case})
  keyblock_test(vtu/${CMAKE_MATCH_1} tools CAN_SKIP RANKS ${CMAKE_MATCH_2}
    COMMAND vtu.py ${keyblock} ${prm} ${out}/vtu_${CMAKE_MATCH_1} ${CMAKE_MATCH_1})
endforeach()

# reports of runs: tables, pages, and what they do without some of the files
set(report ${contrib}/keyblock-report)
foreach(case plane wedge bolts study poor)
  keyblock_test(report/${case} tools
    COMMAND report.py ${keyblock} ${report} ${prm} ${out}/report_${case} ${case})
endforeach()
foreach(case altered statics)
  keyblock_test(report/${case} tools
    COMMAND report_${case}.py ${keyblock} ${report} ${prm} ${out}/report_${case})
endforeach()

# pictures of runs, blocks as STL files, and messages where something is missing
foreach(case network solid curves stl missing)
  keyblock_test(pictures/${case} tools CAN_SKIP
    COMMAND pictures.py ${keyblock} ${contrib} ${prm} ${out}/pictures_${case} ${case})
endforeach()
# what contrib/view.py writes and starts
keyblock_test(view tools COMMAND view.py ${keyblock} ${CMAKE_SOURCE_DIR} ${out}/view)
# what contrib/run.sh says and does
keyblock_test(run_script tools COMMAND run_script.py ${CMAKE_SOURCE_DIR} ${out}/run_script)
# what bash offers to complete a command line
keyblock_test(completion tools
  COMMAND completion.py ${keyblock} ${CMAKE_SOURCE_DIR} ${out}/completion)
keyblock_test(install tools COMMAND ${CMAKE_COMMAND} -DBUILD=${CMAKE_BINARY_DIR}
  -DFOLDER=${out}/installed -DPROJECT=${CMAKE_CURRENT_SOURCE_DIR}/package
  -DPYTHON=$<$<BOOL:${PYTHON_MODULE}>:${PYTHON_OF_MODULE}>
  -P ${CMAKE_CURRENT_SOURCE_DIR}/package/install.cmake)

# the manual is made without a warning, if Sphinx is there; what its pages ask the
# reader to do gives what they say
keyblock_test(manual/pages tools CAN_SKIP COMMAND ${contrib}/manual.sh ${out}/manual)
foreach(case "install quick" "first_tunnel tools" "roof_wedge tools" "powerhouse tools"
    "supports tools")
  string(REGEX MATCH "(.*) (.*)" case ${case})
  keyblock_test(manual/${CMAKE_MATCH_1} ${CMAKE_MATCH_2} COMMAND tutorial.py
    ${CMAKE_SOURCE_DIR}/doc/manual/${CMAKE_MATCH_1}.md ${keyblock}
    ${out}/manual_${CMAKE_MATCH_1})
endforeach()
keyblock_test(manual/wrong_number tools COMMAND tutorial.py
  ${CMAKE_CURRENT_SOURCE_DIR}/tutorial_wrong.md /bin/true # (no mesh, no slack)
  ${out}/manual_wrong_number
  PASS "the page has .*1.117.*what came out is .*1.1162")

# an include of a later room fails, files and functions can be read at once, what the
# documents name is there, and doc/parameters.md is what the program prints
keyblock_test(rooms/upward_include quick
  COMMAND ${CMAKE_COMMAND} --build ${CMAKE_BINARY_DIR} --target upward_include
  PASS "keyblock/step/step.h: No such file")
keyblock_test(rooms/layers quick COMMAND ${contrib}/layers.py)
keyblock_test(rooms/classes quick COMMAND ${contrib}/classes.py)
keyblock_test(documents quick COMMAND documents.py ${CMAKE_SOURCE_DIR})
keyblock_test(parameters_documented quick COMMAND sh -c
  "${keyblock} --print-parameters | diff - ${CMAKE_SOURCE_DIR}/doc/parameters.md")
# what tells two builds apart
keyblock_test(compare_builds quick COMMAND compare_builds.py ${out}/compare_builds)
