# What `cmake --install` puts where: the program, the public headers for plug-ins, and the package that
# find_package(hlodbench) finds.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(plugin_headers ${PROJECT_SOURCE_DIR}/src/traversals/plugin)
add_library(hlodbench_plugin INTERFACE)
add_library(hlodbench::plugin ALIAS hlodbench_plugin)
set_target_properties(hlodbench_plugin PROPERTIES EXPORT_NAME plugin)
target_compile_features(hlodbench_plugin INTERFACE cxx_std_17)
target_include_directories(hlodbench_plugin INTERFACE
  $<BUILD_INTERFACE:${plugin_headers}> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}>)

install(TARGETS hlodbench RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(DIRECTORY ${plugin_headers}/hlodbench DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN *.h)
install(TARGETS hlodbench_plugin EXPORT hlodbenchTargets)

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/hlodbench)
install(EXPORT hlodbenchTargets NAMESPACE hlodbench:: DESTINATION ${package_dir})
configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/hlodbenchConfig.cmake.in
  ${PROJECT_BINARY_DIR}/hlodbenchConfig.cmake INSTALL_DESTINATION ${package_dir})
# headers only: any architecture; the loader checks the rest
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hlodbenchConfigVersion.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
install(FILES ${PROJECT_BINARY_DIR}/hlodbenchConfig.cmake
              ${PROJECT_BINARY_DIR}/hlodbenchConfigVersion.cmake DESTINATION ${package_dir})
