# Installs the rooms as targets lambent::<room>, all of them together as lambent::lambent, their
# headers, and the CMake package that finds both.
include(CMakePackageConfigHelpers)

get_property(rooms GLOBAL PROPERTY LAMBENT_ROOMS)
add_library(lambent_all INTERFACE)
add_library(lambent::lambent ALIAS lambent_all)
set_target_properties(lambent_all PROPERTIES EXPORT_NAME lambent)
target_link_libraries(lambent_all INTERFACE ${rooms})

set(package ${CMAKE_INSTALL_LIBDIR}/cmake/lambent)
install(TARGETS ${rooms} lambent_all EXPORT lambentTargets
        ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT lambentTargets NAMESPACE lambent:: DESTINATION ${package})

foreach(room IN LISTS rooms)
  string(REPLACE "lambent_" "" name ${room})
  install(DIRECTORY lambent/${name}/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/lambent/${name}
          FILES_MATCHING PATTERN "*.h" PATTERN "test_*" EXCLUDE PATTERN "*_test.h" EXCLUDE)
endforeach()

configure_package_config_file(cmake/lambentConfig.cmake.in
  ${CMAKE_CURRENT_BINARY_DIR}/lambentConfig.cmake INSTALL_DESTINATION ${package})
write_basic_package_version_file(${CMAKE_CURRENT_BINARY_DIR}/lambentConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/lambentConfig.cmake
              ${CMAKE_CURRENT_BINARY_DIR}/lambentConfigVersion.cmake
        DESTINATION ${package})
# What --json prints.
install(DIRECTORY spec/json/ DESTINATION ${CMAKE_INSTALL_DATADIR}/lambent/json
        FILES_MATCHING PATTERN "*.json")
install(FILES LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
