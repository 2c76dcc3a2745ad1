// GLSL with its includes resolved: what both machines start from.
#pragma once

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace twinshade {

enum class ShaderStage : std::uint8_t { fragment, compute };

// What the CPU computes a shader's floats in. full: as they are declared, with 32 bits. mediump: what the shader's own
// precision qualifiers (ES) leave to mediump or lowp is computed in 16, in IEEE halves, as a GPU may that takes them at
// their word. half: everything is. by_line: what is on the lines that are switched on (kHalfLines, translate.h) is;
// with all of them on as half, with none as full. OpenGL's backends take no notice.
enum class Precision : std::uint8_t { full, mediump, half, by_line };

// One fragment or compute shader, whole. Lines of `text` map back to files through `files`: the text contains
//   #line N "path"     (GL_GOOGLE_cpp_style_line_directive; what glslang gets)
// and gl_text() turns those into  #line N k  for drivers, k an index into files.
struct ShaderSource {
  std::string name;                // technique name, or the user's file name without folder and ending
  std::string text;                // no #version line unless the author wrote one; then it is the first line
  std::vector<std::string> files;  // as they appear in messages; files[0] is the main file
  // Of these, those that are built-in shaders, byte for byte, wherever they were read. No other file has the name of
  // one
  // ("shaders/exact/dot.glsl"; "./shaders/exact/dot.glsl" is the author's own).
  std::set<std::string> builtin_files = {};
  int version = 450;  // of the author's #version line, 450 where there is none
  bool es = false;
  ShaderStage stage = ShaderStage::fragment;  // by the main file's name: compute where it ends in .comp
  Precision precision = Precision::full;
};

// What stands outside of a shader's files and decides what they say.
struct SourceOptions {
  std::vector<std::string> include_folders = {};  // where #include looks, in this order
  std::vector<std::string> defines = {};          // "NAME=VALUE", "NAME" for 1: macros in front of the main file
};

// UserError where a define is none: NAME is no name of a macro's, or one of GLSL's own, or VALUE has ends of lines.
void require_define(const std::string& define);

// Searches, in order: the folder of the including file (none for a main text that is no file and whose path names no
// folder), then the folders of the options, then the built-in shaders
// (embedded in the binary, addressed as "exact/dot.glsl", "basis/sh.glsl" ...). Include once per file: a second
// #include of the same file is empty, but of a list of macro calls (source/macro_list.h). UserError "file:line: cannot
// include "x": not found in ..." and where includes go deeper than 100, as loops do. UserError where the file's name
// ends like those of other stages (.vert, .geom ...).
ShaderSource load_shader(const std::string& path, const SourceOptions& options = {});
// UserError where an include folder that someone names ("builtin:...": of the shaders in the program) does not exist.
void require_include_folder(const std::string& folder);
// The same for what only fragment shaders do; a compute shader is refused by name.
ShaderSource load_fragment_shader(const std::string& path, const SourceOptions& options = {});
ShaderSource resolve_shader(const std::string& name, const std::string& main_text, const std::string& main_path,
                            const SourceOptions& options = {});

// Text for an OpenGL driver: the given version line, optional lines after it, #line with numbers.
std::string gl_text(const ShaderSource& source, const std::string& version_line, const std::string& extra_lines);

// Rewrites the "k:line" or "k(line)" positions of a Mesa log into "file:line".
std::string map_driver_log(const ShaderSource& source, const std::string& log);

// SHA-256 of version, es, stage, text and, but for full, precision.
std::string source_hash(const ShaderSource& source);

}  // namespace twinshade
