# `cmake --install`: the command, the libraries with their public headers, and what find_package(relief)
# needs.
include(CMakePackageConfigHelpers)

# The headers that a program includes by name. What they include is public too; all other headers may
# change at any time. tests/install compiles each installed header by itself.
set(RELIEF_PUBLIC_HEADERS
  common/compare/compare.h common/error.h common/export/export.h common/image/image_io.h common/image/srgb.h
  common/io/file.h common/mesh/mesh_texture.h common/mesh/normal_texture.h common/patch.h
  common/patch_file/patch_file.h common/patch_file/patch_tree.h common/patch_file/tree_tile.h common/points.h common/progress.h
  common/scene/scene.h common/transform.h common/version.h
  integrations/openmesh.h integrations/pcl.h
  loader/load_files.h loader/load_scene.h loader/scene/scene_plan.h loader/scene/view_settings.h
  preprocess/convert.h preprocess/convert_options.h preprocess/convert_tiles.h
  preprocess/normals/known_sides.h
  preprocess/readers/read_points.h preprocess/readers/read_result.h preprocess/tiles/tile_options.h
  renderer/geometry/meshes/mesh_of_patches.h renderer/geometry/meshes/mesh_of_points.h
  renderer/geometry/meshes/points_of_patches.h renderer/render.h renderer/viewport.h)
install(CODE "
  set(SOURCE ${PROJECT_SOURCE_DIR})
  set(STAGE ${PROJECT_BINARY_DIR}/include/relief)
  set(DESTINATION \${CMAKE_INSTALL_PREFIX}/${CMAKE_INSTALL_INCLUDEDIR}/relief)
  set(HEADERS ${RELIEF_PUBLIC_HEADERS})
  include(${PROJECT_SOURCE_DIR}/cmake/InstallHeaders.cmake)")

foreach(module common preprocess renderer loader)
  set_target_properties(relief_${module} PROPERTIES EXPORT_NAME ${module})
  add_library(relief::${module} ALIAS relief_${module})
endforeach()
install(TARGETS relief relief_common relief_preprocess relief_renderer relief_loader EXPORT relief
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
