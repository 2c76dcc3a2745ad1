# Lists the built-in shading functions and techniques for the build.

set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS
  ${CMAKE_SOURCE_DIR}/lighting/registry.def ${CMAKE_SOURCE_DIR}/lighting/sphere_maps.def)
file(STRINGS ${CMAKE_SOURCE_DIR}/lighting/registry.def registry_lines REGEX "^(BASIS|TECHNIQUE)\\(")
# TWINSHADE_SHADERS: name:kind of what the build translates: the technique with its coefficients from lightmaps, vertices and
# volumes, as its domain allows, and what the host evaluates of a basis or of a sphere map. From lighting/registry.def and lighting/sphere_maps.def, the only
# lists. TWINSHADE_CODE_OF_<name>: the first basis of the same file. They are evaluated alike, and differ in how light is
# projected: the same code serves both.
set(TWINSHADE_SHADERS "")
foreach(line IN LISTS registry_lines)
  string(REGEX REPLACE "^(BASIS|TECHNIQUE)\\(([a-z0-9_]+),.*" "\\2" name "${line}")
  if(line MATCHES "^BASIS\\([^,]*, ([a-z0-9_]+)\\.glsl,")
    if(NOT DEFINED first_of_${CMAKE_MATCH_1})
      set(first_of_${CMAKE_MATCH_1} ${name})
    endif()
    set(TWINSHADE_CODE_OF_${name} ${first_of_${CMAKE_MATCH_1}})
  endif()
  if(NOT line MATCHES "^BASIS\\([^,]*,[^,]*, sphere,")
    list(APPEND TWINSHADE_SHADERS ${name}:lightmap ${name}:vertex)
  endif()
  if(line MATCHES "^BASIS\\([^,]*,[^,]*, (sphere|either),")
    list(APPEND TWINSHADE_SHADERS ${name}:volume)
  endif()
  if(line MATCHES "^BASIS\\(")
    list(APPEND TWINSHADE_SHADERS ${name}:basis_irradiance)
  endif()
  if(line MATCHES "^BASIS\\([^,]*,[^,]*,[^,]*,[^,]*, true,")
    list(APPEND TWINSHADE_SHADERS ${name}:basis_values)
  endif()
endforeach()
# Techniques of precomputed visibility: from lightmaps, on the first sphere map. Others are compiled when they are asked for.
file(STRINGS ${CMAKE_SOURCE_DIR}/lighting/registry.def visibility_lines REGEX "^VISIBILITY\\(")
foreach(line IN LISTS visibility_lines)
  string(REGEX REPLACE "^VISIBILITY\\(([a-z0-9_]+),.*" "\\1" name "${line}")
  list(APPEND TWINSHADE_SHADERS ${name}:lightmap)
endforeach()
file(STRINGS ${CMAKE_SOURCE_DIR}/lighting/sphere_maps.def map_lines REGEX "^SPHERE_MAP\\(")
foreach(line IN LISTS map_lines)
  string(REGEX REPLACE "^SPHERE_MAP\\(([a-z0-9_]+),.*" "\\1" name "${line}")
  list(APPEND TWINSHADE_SHADERS ${name}:map_taps ${name}:map_direction)
endforeach()

set(TWINSHADE_BUILTIN ".*" CACHE STRING "which shaders (name:kind) to build in, as a regular expression: others are compiled when first asked for")
list(FILTER TWINSHADE_SHADERS INCLUDE REGEX "${TWINSHADE_BUILTIN}")

file(GLOB_RECURSE TWINSHADE_GLSL_FILES CONFIGURE_DEPENDS RELATIVE ${CMAKE_SOURCE_DIR}/shaders
  ${CMAKE_SOURCE_DIR}/shaders/*.glsl ${CMAKE_SOURCE_DIR}/shaders/*.frag)
