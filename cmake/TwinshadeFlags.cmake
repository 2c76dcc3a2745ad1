# Floating point is a contract: no contraction, no fast-math, in every object. Instruction sets only where code merely
# reads (raster, shade): everything else is built for the baseline of the platform.
add_library(twinshade_flags INTERFACE)
target_compile_options(twinshade_flags INTERFACE -ffp-contract=off -fno-math-errno -fno-trapping-math
  -Wall -Wextra -Wpedantic -Wshadow -Werror -Wno-psabi)
target_include_directories(twinshade_flags INTERFACE ${CMAKE_SOURCE_DIR})
if(TWINSHADE_SANITIZE)
  set(sanitize -fsanitize=${TWINSHADE_SANITIZE} -fno-sanitize-recover=all -fno-omit-frame-pointer)
  if(TWINSHADE_SANITIZE MATCHES undefined)
    # vptr: Debian's glslang is built without the type information that this check needs.
    list(APPEND sanitize -fno-sanitize=vptr)
  endif()
  # Not where a target sets TWINSHADE_UNSANITIZED.
  target_compile_options(twinshade_flags INTERFACE
    "$<$<NOT:$<BOOL:$<TARGET_PROPERTY:TWINSHADE_UNSANITIZED>>>:${sanitize}>")
  target_link_options(twinshade_flags INTERFACE -fsanitize=${TWINSHADE_SANITIZE})
endif()
string(REPLACE "-O2" "-O3" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
# Release keeps its checks of invariants: they do not use NDEBUG.

# Instruction sets and the number types that are built for each (bits of enum Number: lanes4 1, lanes8 2, lanes16 4,
# scalar 8, float64 16).
if(CMAKE_SYSTEM_PROCESSOR MATCHES "x86_64|AMD64")
  set(TWINSHADE_ISAS baseline avx2 avx512)
  set(TWINSHADE_ISA_FLAGS_baseline -march=x86-64-v2)
  set(TWINSHADE_ISA_FLAGS_avx2 -march=x86-64-v3)
  set(TWINSHADE_ISA_FLAGS_avx512 -march=x86-64-v4 -mprefer-vector-width=512)
else()
  set(TWINSHADE_ISAS baseline)
  set(TWINSHADE_ISA_FLAGS_baseline "")
endif()
set(TWINSHADE_NUMBERS_baseline 31)
set(TWINSHADE_NUMBERS_avx2 2)
set(TWINSHADE_NUMBERS_avx512 4)

# twinshade_isa_objects(NAME OUT_OBJECTS [HEADER precompiled_header.h] source...): compiles the sources once per instruction set,
# with the macros TWINSHADE_ISA and TWINSHADE_NUMBERS; OUT_OBJECTS receives the object expressions.
function(twinshade_isa_objects name out)
  cmake_parse_arguments(O "" "HEADER" "" ${ARGN})
  set(objects "")
  foreach(isa ${TWINSHADE_ISAS})
    add_library(${name}_${isa} OBJECT ${O_UNPARSED_ARGUMENTS})
    if(O_HEADER)
      target_precompile_headers(${name}_${isa} PRIVATE ${CMAKE_SOURCE_DIR}/${O_HEADER})
    endif()
    target_link_libraries(${name}_${isa} PRIVATE twinshade_flags)
    target_compile_options(${name}_${isa} PRIVATE ${TWINSHADE_ISA_FLAGS_${isa}})
    target_compile_definitions(${name}_${isa} PRIVATE TWINSHADE_ISA=${isa} TWINSHADE_NUMBERS=${TWINSHADE_NUMBERS_${isa}})
    list(APPEND objects $<TARGET_OBJECTS:${name}_${isa}>)
  endforeach()
  set(${out} ${objects} PARENT_SCOPE)
endfunction()

# A library of the project: add_library + the flags above.
function(twinshade_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PUBLIC twinshade_flags)
endfunction()

# A doctest executable, registered with CTest as one test of the same name. LABELS slow for those outside the default run.
function(twinshade_test name)
  cmake_parse_arguments(T "" "LABELS" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${T_SOURCES} ${CMAKE_SOURCE_DIR}/tests/main.cpp)
  target_link_libraries(${name} PRIVATE twinshade_flags ${T_LIBRARIES})
  target_compile_definitions(${name} PRIVATE TWINSHADE_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT 900)
  if(TWINSHADE_SANITIZE MATCHES address)
    set_tests_properties(${name} PROPERTIES ENVIRONMENT
      "LSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/cmake/leaks.supp:print_suppressions=0")
  endif()
  if(T_LABELS)
    set_tests_properties(${name} PROPERTIES LABELS ${T_LABELS})
  endif()
endfunction()
