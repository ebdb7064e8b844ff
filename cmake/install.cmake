# What `cmake --install` puts where: bin/weft, static libraries, headers under include/weft, data under share/weft, and
# the package config for find_package(weft), and .pc files for pkg-config: weft-graph, and weft for all of it.
include(CMakePackageConfigHelpers)

install(DIRECTORY engine DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/weft FILES_MATCHING PATTERN "*.h")
install(DIRECTORY graphs shaders materials scenes words DESTINATION ${CMAKE_INSTALL_DATADIR}/weft)
install(FILES docs/errors.md DESTINATION ${CMAKE_INSTALL_DATADIR}/weft/docs)
set(weft_package ${CMAKE_INSTALL_LIBDIR}/cmake/weft)
install(EXPORT weft_core NAMESPACE weft:: FILE weftCore.cmake DESTINATION ${weft_package})
if(WEFT_GL)
  install(TARGETS weft RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(DIRECTORY ${CMAKE_BINARY_DIR}/glad/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/weft)
  install(EXPORT weft_gl NAMESPACE weft:: FILE weftGl.cmake DESTINATION ${weft_package})
endif()
# As seen from the folder of the .pc files, so that the prefix may be chosen when it is installed.
file(RELATIVE_PATH WEFT_PC_PREFIX "/${CMAKE_INSTALL_LIBDIR}/pkgconfig" "/")
foreach(package weft-graph weft)
  if(package STREQUAL weft-graph OR WEFT_GL)
    configure_file(${CMAKE_CURRENT_LIST_DIR}/${package}.pc.in ${CMAKE_BINARY_DIR}/${package}.pc @ONLY)
    install(FILES ${CMAKE_BINARY_DIR}/${package}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
  endif()
endforeach()
if(WEFT_GL)
  install(FILES app/completion.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME weft)
endif()
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/weftConfig.cmake.in ${CMAKE_BINARY_DIR}/weftConfig.cmake
  INSTALL_DESTINATION ${weft_package} PATH_VARS CMAKE_INSTALL_DATADIR)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/weftConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/weftConfig.cmake ${CMAKE_BINARY_DIR}/weftConfigVersion.cmake DESTINATION ${weft_package})
