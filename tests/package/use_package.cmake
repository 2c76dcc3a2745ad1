# cmake -D BUILD=... -D PROJECT=... -D COMPILER=... -D GENERATOR=... -D WORK=... -D EXECUTABLE=... -D EXPECTED=... -D SANITIZE=... -P use_package.cmake
# Installs BUILD's package into WORK, builds PROJECT against it and runs EXECUTABLE, whose output must match EXPECTED.
function(run)
  execute_process(COMMAND ${ARGN} RESULT_VARIABLE status OUTPUT_VARIABLE said ERROR_VARIABLE said)
  if(NOT status EQUAL 0)
    string(JOIN " " command ${ARGN})
    message(FATAL_ERROR "${command}: ${status}\n${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${WORK})
file(MAKE_DIRECTORY ${WORK})
run(${CMAKE_COMMAND} --install ${BUILD} --component cpp --prefix ${WORK}/installed)
# Who links libraries made for sanitizers needs them too.
set(flags -ffast-math)
if(SANITIZE)
  string(APPEND flags " -fsanitize=${SANITIZE}")
endif()
# A project with -ffast-math of its own must still get the exact bits: its shaders are compiled under the contract regardless.
run(${CMAKE_COMMAND} -S ${PROJECT} -B ${WORK}/build -G ${GENERATOR} -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_BUILD_TYPE=Release
  -D "CMAKE_CXX_FLAGS=${flags}" -D twinshade_ROOT=${WORK}/installed)
run(${CMAKE_COMMAND} --build ${WORK}/build)
run(${WORK}/build/${EXECUTABLE})
if(NOT said MATCHES "${EXPECTED}")
  message(FATAL_ERROR "${EXECUTABLE} printed\n${said}not\n${EXPECTED}")
endif()
# A second build has nothing to do: what the shaders are made from is known.
run(${CMAKE_COMMAND} --build ${WORK}/build)
if(said MATCHES "Building|Translating")
  message(FATAL_ERROR "an unchanged project is built again:\n${said}")
endif()
