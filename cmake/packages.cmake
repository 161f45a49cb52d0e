# Debian packages, one for each component of the installation: cpack -G DEB. scripts/packages sets what they need: a
# shared library, /usr as the prefix and Debian's library folder.

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")  # each package says its own
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ
                                                WORLD_EXECUTE)
set(CPACK_PACKAGE_VENDOR "the spincat authors")
# As Debian's own tools have it: DEBFULLNAME and DEBEMAIL.
set(maintainer "the spincat authors <spincat@localhost>")
if(DEFINED ENV{DEBEMAIL} AND DEFINED ENV{DEBFULLNAME})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(SPINCAT_MAINTAINER ${maintainer} CACHE STRING "Who answers for the Debian packages")
set(CPACK_PACKAGE_CONTACT ${SPINCAT_MAINTAINER})
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${PROJECT_BINARY_DIR}/src/spincat)
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENTS_ALL "")
set(package_version ${PROJECT_VERSION}-1)

# COMPONENT PACKAGE SECTION SUMMARY: text of the description, after what all have in common. Further arguments are
# Debian's fields, by name: DEPENDS "..." RECOMMENDS "...".
function(spincat_package component package section summary text)
  string(TOUPPER ${component} upper)
  set(prefix CPACK_DEBIAN_${upper})
  set(${prefix}_PACKAGE_NAME ${package} PARENT_SCOPE)
  set(${prefix}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(${prefix}_DESCRIPTION "${summary}\nspincat learns object categories from 3D models by spin images and names\nnew meshes and point clouds.\n.\n${text}" PARENT_SCOPE)
  while(ARGN)
    list(POP_FRONT ARGN field value)
    set(${prefix}_PACKAGE_${field} "${value}" PARENT_SCOPE)
  endwhile()
  install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package} RENAME copyright COMPONENT ${component})
  install(FILES ${PROJECT_BINARY_DIR}/package/changelog.Debian.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${package}
          COMPONENT ${component})
  set(CPACK_COMPONENTS_ALL ${CPACK_COMPONENTS_ALL} ${component} PARENT_SCOPE)
endfunction()

# What Debian's own changelog would say: where the changes stand.
string(TIMESTAMP date "%a, %d %b %Y 00:00:00 +0000" UTC)
file(WRITE ${PROJECT_BINARY_DIR}/package/changelog.Debian
  "spincat (${package_version}) bookworm; urgency=medium\n\n  * Version ${PROJECT_VERSION}; its changes are in CHANGELOG.md of spincat-doc.\n\n"
  " -- ${CPACK_PACKAGE_CONTACT}  ${date}\n")
execute_process(COMMAND gzip -9nf ${PROJECT_BINARY_DIR}/package/changelog.Debian COMMAND_ERROR_IS_FATAL ANY)

spincat_package(command spincat science "object categories from 3D models" "This package has the command." 
  SUGGESTS "spincat-openmpi | spincat-mpich, spincat-doc")
spincat_package(library libspincat0 libs "object categories from 3D models, shared library"
  "This package has what programs need to run.")
spincat_package(development libspincat-dev libdevel "object categories from 3D models, development files"
  "This package has the headers, and what CMake and pkg-config need to know."
  DEPENDS "libspincat0 (= ${package_version}), libeigen3-dev")
spincat_package(documentation spincat-doc doc "object categories from 3D models, documentation"
  "This package has the guides, the reference and what was measured." ARCHITECTURE all)
if(spincat_has_python)
  math(EXPR next "${Python3_VERSION_MINOR} + 1")
  spincat_package(python python3-spincat python "object categories from 3D models, Python package"
    "This package has the module spincat, whose classifier follows the protocol\nof scikit-learn."
    DEPENDS "python3 (>= 3.${Python3_VERSION_MINOR}~), python3 (<< 3.${next}~), python3-numpy" SUGGESTS python3-sklearn)
endif()
foreach(mpi ${SPINCAT_MPI_PLUGINS})
  spincat_package(${mpi} spincat-${mpi} science "object categories from 3D models, many machines"
    "This package lets the launcher of ${mpi} share the command's work out to\nmany processes."
    DEPENDS "spincat (= ${package_version})")
endforeach()
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
file(WRITE ${PROJECT_BINARY_DIR}/package/triggers "activate-noawait ldconfig\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_BINARY_DIR}/package/triggers)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")

install(DIRECTORY docs DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spincat-doc COMPONENT documentation)
install(FILES README.md CHANGELOG.md CITATION.cff DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/spincat-doc COMPONENT documentation)

# Completions and manual pages, from the command's own help.
find_program(HELP2MAN help2man REQUIRED)
set(made ${PROJECT_BINARY_DIR}/package)
set(share ${CMAKE_INSTALL_DATADIR})
add_custom_target(spincat_pages ALL COMMAND ${CMAKE_COMMAND} -DCOMMAND=$<TARGET_FILE:spincat_command> -DHELP2MAN=${HELP2MAN}
  -DVERSION=${PROJECT_VERSION} -DOUT=${made} -P ${PROJECT_SOURCE_DIR}/cmake/command_pages.cmake)
install(DIRECTORY ${made}/man1 DESTINATION ${share}/man COMPONENT command)
install(FILES ${made}/spincat.bash DESTINATION ${share}/bash-completion/completions RENAME spincat COMPONENT command)
install(FILES ${made}/spincat.zsh DESTINATION ${share}/zsh/vendor-completions RENAME _spincat COMPONENT command)
install(FILES ${made}/spincat.fish DESTINATION ${share}/fish/vendor_completions.d COMPONENT command)

include(CPack)
