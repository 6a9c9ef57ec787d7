# What must not matter does not: contrib/metamorphic.py, its parts, five scenes with
# some of the changes, and each scene that has a factor with all of them.
keyblock_test(metamorphic/parts quick
  COMMAND metamorphic.py ${keyblock} ${out}/metamorphic_parts)
foreach(case "slanted_wedge both bolt-in-rock,bolt-later,weakening-joint-far,joints-far-50,turned-obliquely,cells-0.96"
    "bolted_incline both quick" "crack_water both quick" "factor_group statics quick"
    "wedge_3d statics quick")
  separate_arguments(case UNIX_COMMAND "${case}")
  list(GET case 0 scene)
  list(GET case 1 method)
  list(GET case 2 relations)
  keyblock_test(metamorphic/${scene}.quick quick COST 80
    COMMAND ${contrib}/metamorphic.py ${verification}/${scene}.prm --jobs 1
      --keyblock ${keyblock} --method ${method} --relations ${relations})
endforeach()
file(GLOB scenes CONFIGURE_DEPENDS ${verification}/*.prm ${prm}/tutorial/*.prm)
foreach(scene ${scenes})
  file(STRINGS ${scene} has_factor REGEX "^subsection Safety factor")
  if(has_factor)
    get_filename_component(name ${scene} NAME_WE)
    get_filename_component(folder ${scene} DIRECTORY)
    get_filename_component(folder ${folder} NAME)
    keyblock_test(metamorphic/${folder}/${name} nightly TIMEOUT 7200 RANKS 2
      COMMAND ${contrib}/metamorphic.py ${scene} --method both --timeout 600
        --keyblock ${keyblock})
  endif()
endforeach()
