# The target `documentation`: pages of all classes and functions, and of doc/*.md,
# in documentation/html of the build folder, if Doxygen is there.
find_package(Doxygen QUIET)
if(DOXYGEN_FOUND)
  set(DOXYGEN_PROJECT_BRIEF "Blocks of rock around underground caverns")
  set(DOXYGEN_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/documentation)
  set(DOXYGEN_USE_MDFILE_AS_MAINPAGE ${CMAKE_SOURCE_DIR}/doc/main_page.md)
  set(DOXYGEN_FILTER_PATTERNS
    "*.md=sed -f ${CMAKE_SOURCE_DIR}/contrib/formulas.sed")
  set(DOXYGEN_USE_MATHJAX YES)
  set(DOXYGEN_JAVADOC_AUTOBRIEF YES)
  set(DOXYGEN_EXTRACT_ALL YES)
  set(DOXYGEN_SOURCE_BROWSER YES)
  set(DOXYGEN_HAVE_DOT NO)
  set(DOXYGEN_QUIET YES)
  set(DOXYGEN_WARN_IF_UNDOCUMENTED NO)
  set(DOXYGEN_WARN_IF_INCOMPLETE_DOC NO)
  set(DOXYGEN_STRIP_FROM_INC_PATH ${CMAKE_SOURCE_DIR}/include)
  file(GLOB documents CONFIGURE_DEPENDS doc/*.md)
  list(FILTER documents EXCLUDE REGEX "/index.md$") # of the manual
  doxygen_add_docs(documentation README.md CONTRIBUTING.md CHANGELOG.md
    LICENSE.md ${documents} include/keyblock source
    COMMENT "Pages from the comments of the source")
endif()

# The target `manual`: HTML from doc/, in manual of the build folder, if Sphinx and
# MyST are there; see contrib/manual.sh.
find_program(sphinx_build sphinx-build HINTS /usr/bin)
if(sphinx_build)
  add_custom_target(manual
    COMMAND ${CMAKE_SOURCE_DIR}/contrib/manual.sh ${CMAKE_BINARY_DIR}/manual
    COMMENT "The manual" VERBATIM)
endif()
