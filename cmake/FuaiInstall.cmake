# Installation: libraries, headers, program, bundled data and the CMake package.
include(CMakePackageConfigHelpers)

get_property(fuai_layers GLOBAL PROPERTY FUAI_LAYER_TARGETS)
get_property(fuai_headers GLOBAL PROPERTY FUAI_HEADERS)
get_property(FUAI_INSTALL_PICTURES GLOBAL PROPERTY FUAI_HAS_PICTURES)
get_property(FUAI_INSTALL_WINDOW GLOBAL PROPERTY FUAI_HAS_WINDOW)

install(TARGETS ${fuai_layers} EXPORT fuaiTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(TARGETS fuai_program RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
foreach(header IN LISTS fuai_headers)
  get_filename_component(folder "${header}" DIRECTORY)
  install(FILES "${PROJECT_SOURCE_DIR}/src/${header}" DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/${folder}")
endforeach()
install(DIRECTORY data/ DESTINATION ${CMAKE_INSTALL_DATADIR}/fuai)
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT fuaiTargets NAMESPACE fuai:: DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/fuai)
configure_package_config_file(cmake/fuaiConfig.cmake.in "${CMAKE_BINARY_DIR}/fuaiConfig.cmake"
  INSTALL_DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/fuai)
write_basic_package_version_file("${CMAKE_BINARY_DIR}/fuaiConfigVersion.cmake" COMPATIBILITY SameMinorVersion)
install(FILES "${CMAKE_BINARY_DIR}/fuaiConfig.cmake" "${CMAKE_BINARY_DIR}/fuaiConfigVersion.cmake"
  DESTINATION ${CMAKE_INSTALL_LIBDIR}/cmake/fuai)
