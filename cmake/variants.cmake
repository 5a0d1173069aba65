# Installs the shaders and their variants in HLSL and Metal, which awk, present on every Unix, makes in
# build/variants/{hlsl,metal}.
set(lampion_shaders lampion.glsl coefficients.glsl preintegrated_lookup.h preintegrated_lobe.glsl
  preintegrated_brdf.glsl probe.glsl ggx.glsl coat.glsl area.glsl)
list(TRANSFORM lampion_shaders PREPEND ${PROJECT_SOURCE_DIR}/shaders/lampion/)
set(lampion_shader_folder ${CMAKE_INSTALL_DATADIR}/lampion/shaders)
install(FILES ${lampion_shaders} DESTINATION ${lampion_shader_folder} COMPONENT development)

find_program(AWK awk)
if(AWK)
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
endif()
