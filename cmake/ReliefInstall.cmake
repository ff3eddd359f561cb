# `cmake --install`: the command, the libraries with their public headers, and what find_package(relief)
# needs. A header is public if it is listed here; all others may change at any time.
include(CMakePackageConfigHelpers)

set(RELIEF_PUBLIC_HEADERS
  common/bounds.h common/camera.h common/choices.h common/error.h common/file.h common/image.h common/image_io.h
  common/light.h common/material.h common/mesh_texture.h common/normal_texture.h
  common/octahedral.h common/patch.h common/patch_file.h common/patch_tree.h
  common/instance.h common/points.h common/progress.h common/scene.h
  common/srgb.h common/texture_pyramid.h common/transform.h common/version.h
  preprocess/convert.h preprocess/convert_tiles.h preprocess/read_points.h
  renderer/engines/ewa/settings.h renderer/engines/multipass/settings.h
  renderer/engines/raytrace/settings.h
  renderer/explanation.h renderer/mesh_of_points.h renderer/render.h renderer/splat_cloud.h renderer/triangle_mesh.h)
foreach(header IN LISTS RELIEF_PUBLIC_HEADERS)
  cmake_path(GET header PARENT_PATH folder)
  install(FILES ${header} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/relief/${folder})
endforeach()

foreach(module common preprocess renderer)
  set_target_properties(relief_${module} PROPERTIES EXPORT_NAME ${module})
  add_library(relief::${module} ALIAS relief_${module})
endforeach()
install(TARGETS relief relief_common relief_preprocess relief_renderer EXPORT relief
  RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR}
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR}
  ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})

set(RELIEF_PACKAGE_DIR ${CMAKE_INSTALL_LIBDIR}/cmake/relief)
install(EXPORT relief NAMESPACE relief:: FILE reliefTargets.cmake DESTINATION ${RELIEF_PACKAGE_DIR})
configure_package_config_file(${PROJECT_SOURCE_DIR}/cmake/reliefConfig.cmake.in
  ${PROJECT_BINARY_DIR}/reliefConfig.cmake INSTALL_DESTINATION ${RELIEF_PACKAGE_DIR})
# Before 1.0 every minor version may break what uses it.
write_basic_package_version_file(${PROJECT_BINARY_DIR}/reliefConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/reliefConfig.cmake ${PROJECT_BINARY_DIR}/reliefConfigVersion.cmake
  DESTINATION ${RELIEF_PACKAGE_DIR})
install(FILES LICENSE README.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
