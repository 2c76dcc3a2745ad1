# twinshade_add_shader(TARGET FILE my.frag [NAME name] [INCLUDE folder...] [DEFINE NAME[=VALUE]...] [ISAS isa...])
#
# Translates a fragment shader and compiles it into TARGET, an executable or library of this folder's CMakeLists.txt, whose sources can
# then include "name.h": structs of the shader's uniforms, inputs and outputs, and calls, in namespace `name`.
#   NAME     a C++ identifier that begins with a letter, no function or macro of C and none that TARGET has; else the file's name
#            without folder and ending
#   INCLUDE  where the shader's #includes are looked for, after its own folder
#   DEFINE   macros in front of the shader's text, 1 without a value: one FILE with others under another NAME is a variant
#   ISAS     of baseline, avx2 and avx512: what to compile for; else all. The best that the processor has is chosen at run time.
# Translated shaders are compiled without contraction and without fast-math, whatever the project's own flags say: their results
# are the same bits as everywhere else.
include_guard(GLOBAL)
cmake_policy(PUSH)
cmake_policy(VERSION 3.20)

function(twinshade_add_shader target)
  cmake_parse_arguments(PARSE_ARGV 1 S "" "FILE;NAME" "INCLUDE;DEFINE;ISAS")
  if(NOT TARGET ${target})
    message(FATAL_ERROR "twinshade_add_shader: ${target} is no target; add_executable or add_library comes first")
  endif()
  if(NOT S_FILE OR S_UNPARSED_ARGUMENTS)
    message(FATAL_ERROR "twinshade_add_shader(TARGET FILE my.frag [NAME name] [INCLUDE folder...] [DEFINE NAME[=VALUE]...] [ISAS isa...]); got: ${ARGV}")
  endif()
  get_filename_component(file ${S_FILE} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
  if(NOT EXISTS ${file})
    message(FATAL_ERROR "twinshade_add_shader: ${file} does not exist")
  endif()
  if(file MATCHES "\\.comp(\\.glsl)?$")
    message(FATAL_ERROR "twinshade_add_shader: ${S_FILE} is a compute shader, which has no inputs and outputs to make a header of: "
      "only fragment shaders do")
  endif()
  if(NOT S_NAME)
    get_filename_component(S_NAME ${file} NAME_WE)
  endif()
  if(NOT S_NAME MATCHES "^[A-Za-z][A-Za-z0-9_]*$")
    message(FATAL_ERROR "twinshade_add_shader: ${S_NAME} must begin with a letter and have letters, digits and "
      "underscores only; give another NAME")
  endif()
  if(S_NAME STREQUAL "limits")  # g++'s <limits.h> includes the next one by quotes
    message(FATAL_ERROR "twinshade_add_shader: limits.h would stand in for the system's; give ${S_FILE} another NAME")
  endif()
  set(library ${target}_${S_NAME})
  if(TARGET ${library}_translation)
    message(FATAL_ERROR "twinshade_add_shader: there is a shader ${S_NAME} in ${target} already, or another whose "
      "CMake targets are named ${library}_... too; give ${S_FILE} another NAME")
  endif()
  set(isas ${TWINSHADE_ISAS})
  if(S_ISAS)
    set(isas baseline ${S_ISAS})  # baseline has what single invocations run
    list(REMOVE_DUPLICATES isas)
    foreach(isa IN LISTS isas)
      if(NOT isa IN_LIST TWINSHADE_ISAS)
        message(FATAL_ERROR "twinshade_add_shader: no instruction set ${isa}; there are ${TWINSHADE_ISAS}")
      endif()
    endforeach()
  endif()
  if(NOT CMAKE_CXX_COMPILER_ID MATCHES "GNU|Clang")
    message(FATAL_ERROR "twinshade_add_shader: translated shaders need g++ or clang++, not ${CMAKE_CXX_COMPILER_ID}")
  endif()

  set(folder ${CMAKE_CURRENT_BINARY_DIR}/twinshade/${target})
  set(translation ${folder}/${S_NAME}.cpp)
  set(calls ${folder}/${S_NAME}_calls.cpp)
  set(includes "")
  foreach(include IN LISTS S_INCLUDE)
    get_filename_component(include ${include} ABSOLUTE BASE_DIR ${CMAKE_CURRENT_SOURCE_DIR})
    list(APPEND includes -I ${include})
  endforeach()
  set(defines "")
  foreach(define IN LISTS S_DEFINE)
    list(APPEND defines -D ${define})
  endforeach()
  file(MAKE_DIRECTORY ${folder})
  list(JOIN isas "," isa_list)
  add_custom_command(OUTPUT ${translation} ${calls} ${folder}/${S_NAME}.h
    COMMAND twinshade::translate ${file} ${includes} ${defines} --name ${S_NAME} --isas ${isa_list} --header ${folder}
            --depfile ${translation}.d -o ${translation}
    DEPENDS ${file} twinshade::translate
    DEPFILE ${translation}.d
    COMMENT "Translating ${S_FILE}"
    VERBATIM)
  add_custom_target(${library}_translation DEPENDS ${translation} ${calls} ${folder}/${S_NAME}.h)
  add_dependencies(${target} ${library}_translation)

  _twinshade_objects(${target} ${library}_translation ${library}_calls ${calls} "${TWINSHADE_ISA_FLAGS_baseline}" "")
  foreach(isa IN LISTS isas)
    _twinshade_objects(${target} ${library}_translation ${library}_${isa} ${translation} "${TWINSHADE_ISA_FLAGS_${isa}}"
      "TWINSHADE_ISA=${isa};TWINSHADE_NUMBERS=${TWINSHADE_NUMBERS_${isa}}")
  endforeach()
  # Looked into for quotes only: a shader's time.h must not stand in for the system's <time.h>.
  target_compile_options(${target} PRIVATE "$<$<COMPILE_LANGUAGE:C,CXX>:SHELL:-iquote \"${folder}\">")
  target_link_libraries(${target} PRIVATE twinshade::runtime)
endfunction()

# One object file with flags of its own, linked into the target.
function(_twinshade_objects target translation_target name source flags definitions)
  add_library(${name} OBJECT ${source})
  set_target_properties(${name} PROPERTIES CXX_EXTENSIONS OFF POSITION_INDEPENDENT_CODE ON CXX_VISIBILITY_PRESET hidden
    VISIBILITY_INLINES_HIDDEN ON)
  target_compile_options(${name} PRIVATE ${flags} -fno-fast-math -ffp-contract=off -fno-math-errno -fno-trapping-math -w)
  target_compile_definitions(${name} PRIVATE ${definitions})
  target_link_libraries(${name} PRIVATE twinshade::runtime)
  add_dependencies(${name} ${translation_target})
  target_sources(${target} PRIVATE $<TARGET_OBJECTS:${name}>)
endfunction()

cmake_policy(POP)
