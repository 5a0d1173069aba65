# Manual pages and shell completion, printed by the program itself from the tables that make --help:
# build/manual/{man,bash,zsh,fish}.
if(CMAKE_SCRIPT_MODE_FILE)
  function(print_to file)
    execute_process(COMMAND ${PROGRAM} ${ARGN} OUTPUT_FILE ${file} COMMAND_ERROR_IS_FATAL ANY)
  endfunction()
  file(REMOVE_RECURSE ${OUTPUT})
  file(MAKE_DIRECTORY ${OUTPUT}/man ${OUTPUT}/bash ${OUTPUT}/zsh ${OUTPUT}/fish)
  execute_process(COMMAND ${PROGRAM} --help OUTPUT_VARIABLE help COMMAND_ERROR_IS_FATAL ANY)
  string(REGEX MATCHALL "\n  [a-z]+ " commands "${help}")
  print_to(${OUTPUT}/man/lampion.1 man)
  foreach(command IN LISTS commands)
    string(STRIP "${command}" command)
    print_to(${OUTPUT}/man/lampion-${command}.1 man ${command})
  endforeach()
  print_to(${OUTPUT}/bash/lampion completion bash)
  print_to(${OUTPUT}/zsh/_lampion completion zsh)
  print_to(${OUTPUT}/fish/lampion.fish completion fish)
  file(GLOB pages ${OUTPUT}/man/*.1)
  execute_process(COMMAND gzip -9n ${pages} COMMAND_ERROR_IS_FATAL ANY)
  file(TOUCH ${OUTPUT}/done)
  return()
endif()

set(manual ${PROJECT_BINARY_DIR}/manual)
add_custom_command(OUTPUT ${manual}/done
  COMMAND ${CMAKE_COMMAND} -DPROGRAM=$<TARGET_FILE:lampion_program> -DOUTPUT=${manual}
          -P ${CMAKE_CURRENT_LIST_FILE}
  DEPENDS lampion_program ${CMAKE_CURRENT_LIST_FILE}
  COMMENT "Printing the manual" VERBATIM)
add_custom_target(lampion_manual ALL DEPENDS ${manual}/done)
