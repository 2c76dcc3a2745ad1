# twinshade_embed(OUT_SOURCE SYMBOL ROOT file...): a C++ source that defines
#   std::span<const twinshade::EmbeddedFile> twinshade::SYMBOL()
# with the content of the files, named relative to ROOT, as they are when the program is built.
set(TWINSHADE_EMBED_SCRIPT ${CMAKE_CURRENT_LIST_DIR}/embed_files.cmake)
function(twinshade_embed out symbol root)
  set(source ${CMAKE_CURRENT_BINARY_DIR}/${symbol}.cpp)
  set(paths ${ARGN})
  list(TRANSFORM paths PREPEND ${root}/)
  add_custom_command(OUTPUT ${source}
    COMMAND ${CMAKE_COMMAND} -D OUTPUT=${source} -D SYMBOL=${symbol} -D ROOT=${root} "-DFILES=${ARGN}"
            -P ${TWINSHADE_EMBED_SCRIPT}
    DEPENDS ${paths} ${TWINSHADE_EMBED_SCRIPT}
    COMMENT "Embedding ${symbol}"
    VERBATIM)
  # A change of what is embedded compiles this alone.
  set_source_files_properties(${source} PROPERTIES SKIP_UNITY_BUILD_INCLUSION ON)
  set(${out} ${source} PARENT_SCOPE)
endfunction()
