# Installs the shaders and their variants in HLSL, Metal and WGSL, which awk, present on every Unix, makes in
# build/variants/{hlsl,metal,wgsl}.
set(lampion_shaders lampion.glsl coefficients.glsl preintegrated_lookup.h preintegrated_lobe.glsl
  preintegrated_brdf.glsl probe.glsl ggx.glsl coat.glsl area.glsl)
list(TRANSFORM lampion_shaders PREPEND ${PROJECT_SOURCE_DIR}/shaders/lampion/)
set(lampion_shader_folder ${CMAKE_INSTALL_DATADIR}/lampion/shaders)
install(FILES ${lampion_shaders} DESTINATION ${lampion_shader_folder} COMPONENT development)

find_program(AWK awk)
if(NOT AWK)
  return()
endif()

foreach(language hlsl metal)
  set(folder ${PROJECT_BINARY_DIR}/variants/${language})
  set(variants ${lampion_shaders})
  list(TRANSFORM variants REPLACE ".*/" "${folder}/")
  list(TRANSFORM variants REPLACE "[.]glsl$" ".${language}")
  file(MAKE_DIRECTORY ${folder})
  add_custom_command(OUTPUT ${variants}
    COMMAND ${AWK} -v language=${language} -v folder=${folder}
            -f ${CMAKE_CURRENT_LIST_DIR}/variants.awk ${lampion_shaders}
    DEPENDS ${lampion_shaders} ${CMAKE_CURRENT_LIST_DIR}/variants.awk
    COMMENT "Writing the shaders in ${language}" VERBATIM)
  add_custom_target(lampion_${language} ALL DEPENDS ${variants})
  install(FILES ${variants} DESTINATION ${lampion_shader_folder}/${language} COMPONENT development)
endforeach()

# WGSL has no preprocessor: there is a folder for each kind of lobes, and a module that joins the files.
set(own ${PROJECT_SOURCE_DIR}/shaders/lampion)
set(folder ${PROJECT_BINARY_DIR}/variants/wgsl)
set(texts "")
foreach(kind phong ggx)
  set(shaders ${lampion_shaders})
  if(kind STREQUAL ggx) # stands first, as in GLSL
    list(REMOVE_ITEM shaders ${own}/ggx.glsl)
    list(PREPEND shaders ${own}/ggx.glsl)
  else()
    list(REMOVE_ITEM shaders ${own}/ggx.glsl)
  endif()
  set(variants ${shaders})
  list(TRANSFORM variants REPLACE ".*/([a-z_]+)[.][a-z]+$" "${folder}/${kind}/\\1.wgsl")
  list(APPEND variants ${folder}/${kind}/no_areas.wgsl ${folder}/${kind}/spheres.wgsl)
  file(MAKE_DIRECTORY ${folder}/${kind})
  add_custom_command(OUTPUT ${variants}
    COMMAND ${AWK} -v folder=${folder}/${kind} -f ${CMAKE_CURRENT_LIST_DIR}/glsl.awk
            -f ${CMAKE_CURRENT_LIST_DIR}/wgsl.awk ${shaders}
    COMMAND ${CMAKE_COMMAND} -E copy ${own}/spheres.wgsl ${folder}/${kind}/spheres.wgsl
    DEPENDS ${shaders} ${own}/spheres.wgsl ${CMAKE_CURRENT_LIST_DIR}/glsl.awk ${CMAKE_CURRENT_LIST_DIR}/wgsl.awk
    COMMENT "Writing the shaders in WGSL, lobes of ${kind}" VERBATIM)
  install(FILES ${variants} DESTINATION ${lampion_shader_folder}/wgsl/${kind} COMPONENT development)
  list(APPEND texts ${variants})
endforeach()
set(module ${folder}/lampion.js)
add_custom_command(OUTPUT ${module}
  COMMAND sh -c "\"$0\" -f \"$@\" >${module}" ${AWK} ${CMAKE_CURRENT_LIST_DIR}/texts.awk ${own}/lampion.js ${texts}
  DEPENDS ${texts} ${own}/lampion.js ${CMAKE_CURRENT_LIST_DIR}/texts.awk
  COMMENT "Writing the shaders in WGSL as a module" VERBATIM)
add_custom_target(lampion_wgsl ALL DEPENDS ${module})
install(FILES ${module} DESTINATION ${lampion_shader_folder}/wgsl COMPONENT development)
