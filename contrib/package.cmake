# What `cmake --install` and CPack put where.
install(TARGETS keyblock RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  COMPONENT program)
install(FILES doc/keyblock.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1
  COMPONENT program)
install(FILES contrib/completion/keyblock
  DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions
  COMPONENT program)
install(DIRECTORY prm DESTINATION ${CMAKE_INSTALL_DATADIR}/keyblock
  COMPONENT program)
install(FILES doc/summary.schema.json doc/study.schema.json
  DESTINATION ${CMAKE_INSTALL_DATADIR}/keyblock COMPONENT program)
install(PROGRAMS contrib/keyblock-report DESTINATION ${CMAKE_INSTALL_BINDIR}
  COMPONENT program)
# scripts that the manual names, and what they and keyblock-report share
set(contrib_folder ${CMAKE_INSTALL_DATADIR}/keyblock/contrib)
install(DIRECTORY contrib/report DESTINATION ${contrib_folder}
  COMPONENT program PATTERN "__pycache__" EXCLUDE)
install(PROGRAMS contrib/blocks_stl.py contrib/factor_uncertainty.py
  contrib/figures.py contrib/plot_geostress.py contrib/render.py contrib/view.py
  DESTINATION ${contrib_folder} COMPONENT program)
file(GLOB script_modules CONFIGURE_DEPENDS contrib/figures_*.py
  contrib/render_*.py contrib/script_tools.py)
install(FILES ${script_modules} DESTINATION ${contrib_folder} COMPONENT program)
install(FILES README.md LICENSE.md CHANGELOG.md doc/parameters.md doc/theory.md
  doc/vtu.md
  DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT program)

# the library, for programs that find_package(keyblock) and link Keyblock::keyblock
set(package_folder ${CMAKE_INSTALL_LIBDIR}/cmake/keyblock)
set_target_properties(keyblock_library PROPERTIES OUTPUT_NAME keyblock
  EXPORT_NAME keyblock)
install(TARGETS keyblock_library EXPORT keyblock_targets
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library)
install(DIRECTORY include/keyblock DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
  COMPONENT library PATTERN "python" EXCLUDE)
install(EXPORT keyblock_targets NAMESPACE Keyblock:: DESTINATION ${package_folder}
  COMPONENT library)
include(CMakePackageConfigHelpers)
configure_package_config_file(contrib/keyblock-config.cmake.in
  ${CMAKE_BINARY_DIR}/keyblock-config.cmake INSTALL_DESTINATION ${package_folder})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/keyblock-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/keyblock-config.cmake
  ${CMAKE_BINARY_DIR}/keyblock-config-version.cmake
  DESTINATION ${package_folder} COMPONENT library)

# cpack: one .deb of the program
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME keyblock)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY
  "Key blocks around underground caverns: explicit dynamics with exact contact")
set(CPACK_RESOURCE_FILE_LICENSE ${CMAKE_SOURCE_DIR}/LICENSE.md)
set(CPACK_COMPONENTS_ALL program)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_PROGRAM_PACKAGE_NAME keyblock)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
# of keyblock-report
set(CPACK_DEBIAN_PROGRAM_PACKAGE_RECOMMENDS "python3-matplotlib")
if(PYTHON_MODULE)
  set(version ${PYTHON_VERSION_OF_MODULE})
  string(REGEX REPLACE ".*\\." "" minor ${version})
  math(EXPR next "${minor} + 1")
  set(CPACK_DEBIAN_PROGRAM_PACKAGE_DEPENDS
    "python3 (>= ${version}), python3 (<< 3.${next}), python3-numpy")
endif()
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_MAINTAINER "The Keyblock developers <keyblock@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
include(CPack)
