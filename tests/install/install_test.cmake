# Installs the build into a folder, builds the consumer against that alone, and runs it and `relief`.
file(REMOVE_RECURSE ${WORK})
set(prefix ${WORK}/prefix)

function(step)
  execute_process(COMMAND ${ARGV} RESULT_VARIABLE failed OUTPUT_VARIABLE output ERROR_VARIABLE output)
  if(failed)
    message(FATAL_ERROR "${ARGV}\n${output}")
  endif()
endfunction()

step(${CMAKE_COMMAND} --install ${BUILD} --prefix ${prefix})
step(${CMAKE_COMMAND} -S ${CONSUMER} -B ${WORK}/build -G ${GENERATOR} -D CMAKE_PREFIX_PATH=${prefix}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_CXX_COMPILER_LAUNCHER=${LAUNCHER}
  -D RELIEF_INCLUDE_DIR=${prefix}/include)
step(${CMAKE_COMMAND} --build ${WORK}/build)
step(${WORK}/build/convert_points ${WORK}/square.relief)
step(${prefix}/bin/relief info ${WORK}/square.relief --verify)

file(WRITE ${WORK}/scene.json [[{
  "models": [{"file": "square.relief"}],
  "size": [64, 64],
  "views": [{"name": "onepass", "orbit": [0, 10]}, {"name": "raytrace", "orbit": [0, 10], "engine": "raytrace"}]
}]])
step(${WORK}/build/render_scene ${WORK}/scene.json ${WORK})
foreach(view onepass raytrace)
  if(NOT EXISTS ${WORK}/${view}.png)
    message(FATAL_ERROR "render_scene wrote no ${view}.png")
  endif()
endforeach()
