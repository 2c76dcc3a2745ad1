# Lists the built-in shading functions and techniques for the build.

# TWINSHADE_TECHNIQUES: names in lighting/registry.def, the only list.
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/lighting/registry.def)
file(STRINGS ${CMAKE_SOURCE_DIR}/lighting/registry.def registry_lines REGEX "^(BASIS|TECHNIQUE)\\(")
set(TWINSHADE_TECHNIQUES "")
set(TWINSHADE_LINEAR_BASES "")  # BASIS lines whose fifth field is true
foreach(line IN LISTS registry_lines)
  string(REGEX REPLACE "^(BASIS|TECHNIQUE)\\(([a-z0-9_]+),.*" "\\2" name "${line}")
  list(APPEND TWINSHADE_TECHNIQUES ${name})
  if(line MATCHES "^BASIS\\([^,]*,[^,]*,[^,]*,[^,]*, true,")
    list(APPEND TWINSHADE_LINEAR_BASES ${name})
  endif()
endforeach()

file(GLOB_RECURSE TWINSHADE_GLSL_FILES CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/shaders
  ${CMAKE_SOURCE_DIR}/shaders/*.glsl ${CMAKE_SOURCE_DIR}/shaders/*.frag)
