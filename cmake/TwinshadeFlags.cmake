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
string(REPLACE "-O3" "-O2" CMAKE_CXX_FLAGS_RELEASE "${CMAKE_CXX_FLAGS_RELEASE}")
# -O3 where pixels and rays are counted, -O1 where a build takes longer than the program ever runs, -O0 where what takes time is in
# libraries.
set(TWINSHADE_HOT "$<$<CONFIG:Release>:-O3>")
set(TWINSHADE_COLD "$<$<CONFIG:Release>:-O1>")
set(TWINSHADE_UNOPTIMIZED "$<$<CONFIG:Release>:-O0>")
# GCC's own garbage is collected once it holds more than this (KiB): a tenth of the time, a third more memory a unit.
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  add_compile_options("SHELL:--param ggc-min-heapsize=1000000")
endif()
# Release keeps its checks of invariants: they do not use NDEBUG.

# A quarter of the time of the default linker, and part of the same package. Not with sanitizers, whose runtimes are not tried with it.
if(NOT TWINSHADE_SANITIZE)
  include(CheckLinkerFlag)
  check_linker_flag(CXX -fuse-ld=gold TWINSHADE_GOLD)
  if(TWINSHADE_GOLD)
    add_link_options(-fuse-ld=gold)
  endif()
endif()

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
    set_target_properties(${name}_${isa} PROPERTIES UNITY_BUILD OFF)
    if(O_HEADER)
      target_precompile_headers(${name}_${isa} PRIVATE ${CMAKE_SOURCE_DIR}/${O_HEADER})
    endif()
    target_link_libraries(${name}_${isa} PRIVATE twinshade_flags)
    target_compile_options(${name}_${isa} PRIVATE ${TWINSHADE_ISA_FLAGS_${isa}} ${TWINSHADE_HOT})
    target_compile_definitions(${name}_${isa} PRIVATE TWINSHADE_ISA=${isa} TWINSHADE_NUMBERS=${TWINSHADE_NUMBERS_${isa}})
    list(APPEND objects $<TARGET_OBJECTS:${name}_${isa}>)
  endforeach()
  set(${out} ${objects} PARENT_SCOPE)
endfunction()

# Half a second of each unit is the standard library's headers. Once for libraries, once for programs, whose code is not the same
# kind of position-independent, once for what is not optimised, which others' cannot be used for: twinshade_precompile(NAME [UNOPTIMIZED]).
# With unity builds alone: g++'s preset, without, sees which includes are missing.
function(twinshade_precompile name)
  if(NOT CMAKE_UNITY_BUILD)
    return()
  endif()
  cmake_parse_arguments(P "UNOPTIMIZED" "" "" ${ARGN})
  get_target_property(type ${name} TYPE)
  set(common twinshade_headers_of_libraries)
  if(P_UNOPTIMIZED)
    set(common twinshade_headers_unoptimized)
  elseif(type STREQUAL EXECUTABLE)
    set(common twinshade_headers_of_programs)
  endif()
  if(NOT TARGET ${common})
    set(source ${CMAKE_BINARY_DIR}/${common}.cpp)
    file(CONFIGURE OUTPUT ${source} CONTENT "int main() {}\n")
    if(type STREQUAL EXECUTABLE)
      add_executable(${common} ${source})
    else()
      add_library(${common} OBJECT ${source})
    endif()
    target_link_libraries(${common} PRIVATE twinshade_flags)
    if(P_UNOPTIMIZED)
      target_compile_options(${common} PRIVATE ${TWINSHADE_UNOPTIMIZED})
    endif()
    target_precompile_headers(${common} PRIVATE ${CMAKE_SOURCE_DIR}/base/standard_headers.h)
  endif()
  target_precompile_headers(${name} REUSE_FROM ${common})
  # GCC forgets that these are system headers: false reports on strings (bug 105651).
  if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
    target_compile_options(${name} PRIVATE -Wno-restrict -Wno-array-bounds -Wno-stringop-overflow
      -Wno-stringop-overread)
  endif()
endfunction()

# A library of the project: add_library + the flags above.
function(twinshade_library name)
  add_library(${name} STATIC ${ARGN})
  target_link_libraries(${name} PUBLIC twinshade_flags)
  twinshade_precompile(${name})
endfunction()

# For tests under sanitizers: what is known of libraries that are not ours.
set(TWINSHADE_TEST_ENVIRONMENT "")
if(TWINSHADE_SANITIZE MATCHES address)
  set(TWINSHADE_TEST_ENVIRONMENT "LSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/cmake/leaks.supp:print_suppressions=0")
elseif(TWINSHADE_SANITIZE MATCHES thread)
  set(TWINSHADE_TEST_ENVIRONMENT "TSAN_OPTIONS=suppressions=${CMAKE_SOURCE_DIR}/cmake/races.supp:print_suppressions=0")
endif()

# What `cmake --build` makes only when asked: `--target slow_tests`, `--target benches`.
add_custom_target(slow_tests)
add_custom_target(benches)
function(twinshade_on_request group)
  set_target_properties(${ARGN} PROPERTIES EXCLUDE_FROM_ALL ON)
  add_dependencies(${group} ${ARGN})
endfunction()

# A doctest executable, registered with CTest as one test of the same name. LABELS slow for those outside the default run and build. GL for
# those that draw with OpenGL, where it is built: their main() can become a GL worker. OPTIMIZED for those that compute much themselves.
function(twinshade_test name)
  cmake_parse_arguments(T "GL;OPTIMIZED" "LABELS" "SOURCES;LIBRARIES" ${ARGN})
  if(T_GL AND TWINSHADE_GL)
    set(main gl_test_main)
    list(APPEND T_LIBRARIES twinshade_gl)
  else()
    set(main test_main)
  endif()
  add_executable(${name} ${T_SOURCES} $<TARGET_OBJECTS:${main}>)
  target_link_libraries(${name} PRIVATE twinshade_flags ${T_LIBRARIES})
  if(T_OPTIMIZED)
    set(optimization ${TWINSHADE_COLD})
    twinshade_precompile(${name})
  else()
    set(optimization ${TWINSHADE_UNOPTIMIZED})
    twinshade_precompile(${name} UNOPTIMIZED)
  endif()
  target_compile_definitions(${name} PRIVATE TWINSHADE_HAS_GL=$<BOOL:${TWINSHADE_GL}>)
  # GCC bug 105651: it sees overlaps in "text" + std::string.
  target_compile_options(${name} PRIVATE ${optimization} $<$<CXX_COMPILER_ID:GNU>:-Wno-restrict>)
  target_compile_definitions(${name} PRIVATE TWINSHADE_SOURCE_DIR="${CMAKE_SOURCE_DIR}")
  add_test(NAME ${name} COMMAND ${name})
  if(TWINSHADE_SANITIZE)
    set(time_limit 2700)
  else()
    set(time_limit 900)
  endif()
  set_tests_properties(${name} PROPERTIES TIMEOUT ${time_limit})
  set_tests_properties(${name} PROPERTIES ENVIRONMENT "${TWINSHADE_TEST_ENVIRONMENT}")
  if(T_LABELS)
    set_tests_properties(${name} PROPERTIES LABELS ${T_LABELS})
    if(slow IN_LIST T_LABELS)
      twinshade_on_request(slow_tests ${name})
    endif()
  endif()
endfunction()
