// Resolves #include and leaves #line behind, so that every later message can name the author's file and line.
//
// #version stands before all code; #extension lines outside conditionals move up behind it: they must precede code too,
// and a file that needs one may be included after some. An #include within #if counts where the preprocessor
// reads it.
#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <optional>
#include <set>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "cpu_shaders/shader_source.h"
#include "cpu_shaders/source/builtin_shaders.h"
#include "cpu_shaders/source/directive_scan.h"
#include "cpu_shaders/source/find_word.h"
#include "cpu_shaders/source/line_names.h"
#include "cpu_shaders/source/macro_list.h"
#include "cpu_shaders/source/preprocess.h"
#include "cpu_shaders/source/vulkan_layouts.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

constexpr int kMostIncludes = 100;              // deep
constexpr std::uintmax_t kMostBytes = 4 << 20;  // of one file

struct File {
  std::string shown;     // in messages
  std::string folder;    // where its own includes are looked for first; built-in: relative to shaders/
  std::string identity;  // equal for the same file reached by different names
  std::string text;
  bool builtin = false;
  bool has_folder = true;  // else a text of the program's: no file of the current folder is beside it
};

// "builtin:driver" among the include folders is shaders/driver in the binary.
constexpr std::string_view kBuiltinFolder = "builtin:";

const std::string kBuiltinIdentity = "builtin:", kBuiltinShown = "shaders/";

// With ends of lines and white space that glslang takes for them: it has no form feeds and vertical tabs.
std::string unix_lines(std::string text) {
  if (text.compare(0, 3, "\xef\xbb\xbf") == 0) text.erase(0, 3);
  std::string result;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] == '\f' || text[i] == '\v')
      result += ' ';
    else if (text[i] != '\r')
      result += text[i];
    else if (i + 1 == text.size() || text[i + 1] != '\n')
      result += '\n';
  }
  return result;
}

File builtin_file(const std::string& name, std::string_view text) {
  return {"shaders/" + name, fs::path(name).parent_path().string(), kBuiltinIdentity + name, std::string(text), true};
}

void refuse_large_file(const fs::path& path) {
  std::error_code error;
  const std::uintmax_t size = fs::file_size(path, error);
  if (!error && size > kMostBytes)
    throw UserError(path.string() + ": " + std::to_string(size) + " bytes are more than a shader has: at most " +
                    std::to_string(kMostBytes));
}

std::optional<File> open_file(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return std::nullopt;
  refuse_large_file(path);
  File file;
  file.shown = path.lexically_normal().string();
  file.folder = path.parent_path().string();
  const fs::path canonical = fs::weakly_canonical(path, error);
  file.identity = error ? file.shown : canonical.string();
  file.text = unix_lines(read_file(path.string(), kMostBytes));
  return file;
}

bool is_text_of_builtin(const std::string& name, const std::string& text) {
  const auto builtin = builtin_shader(name);
  return builtin && unix_lines(std::string(*builtin)) == text;
}

// The same built-in reached on disk and in the binary is one file. Another of its name is shown otherwise: what is
// shown as a built-in is taken for it.
void unite_with_builtin(File& file) {
  if (file.builtin) return;
  if (const std::size_t folder = file.identity.rfind("/shaders/"); folder != std::string::npos)
    if (const std::string name = file.identity.substr(folder + 9); is_text_of_builtin(name, file.text))
      file.identity = kBuiltinIdentity + name;
  if (file.shown.rfind(kBuiltinShown, 0) != 0) return;
  const std::string name = file.shown.substr(kBuiltinShown.size());
  if (builtin_shader(name) && !is_text_of_builtin(name, file.text)) file.shown.insert(0, "./");
}

// By the file's name, whose endings are those of glslang and others in use, alone or before .glsl. Another stage's
// shader would mostly pass for a fragment shader and give numbers that mean nothing.
ShaderStage stage_of(const std::string& path) {
  static const std::map<std::string, const char*> others = {
      {".vert", "vertex"},       {".vs", "vertex"},        {".vsh", "vertex"},        {".geom", "geometry"},
      {".gs", "geometry"},       {".gsh", "geometry"},     {".tesc", "tessellation"}, {".tese", "tessellation"},
      {".tcs", "tessellation"},  {".tes", "tessellation"}, {".mesh", "mesh"},         {".task", "task"},
      {".rgen", "ray tracing"},  {".rint", "ray tracing"}, {".rahit", "ray tracing"}, {".rchit", "ray tracing"},
      {".rmiss", "ray tracing"}, {".rcall", "ray tracing"}};
  std::string ending = fs::path(path).extension().string();
  if (ending == ".glsl") ending = fs::path(path).stem().extension().string();
  if (const auto other = others.find(ending); other != others.end())
    throw UserError(path + ": " + ending + " is the ending of a " + other->second +
                    " shader, a stage that is not supported: name fragment shaders .frag, compute shaders .comp");
  return ending == ".comp" ? ShaderStage::compute : ShaderStage::fragment;
}

class Resolver {
 public:
  Resolver(ShaderStage stage, const SourceOptions& options) : include_folders_(options.include_folders), stage_(stage) {
    for (const std::string& define : options.defines) {
      require_define(define);
      const std::size_t equals = define.find('=');
      defines_ += "#define " + define.substr(0, equals) + " " +
                  (equals == define.npos ? "1" : define.substr(equals + 1)) + "\n";
    }
  }

  void resolve(File file) {
    unite_with_builtin(file);
    const bool main = identities_.empty();
    identities_.push_back(file.identity);
    files_.push_back(file.shown);
    if (file.identity.rfind(kBuiltinIdentity, 0) == 0) builtin_files_.insert(file.shown);
    const int outer_depth = conditional_depth_;
    const std::string index = std::to_string(files_.size() - 1);
    line_directive(1, file.shown);
    for (const SourceLine& line : scan_lines(without_vulkan_layouts(file.text))) {
      const std::string where = file.shown + ":" + std::to_string(line.number) + ": ";
      if (line.directive == "if" || line.directive == "ifdef" || line.directive == "ifndef") ++conditional_depth_;
      if (line.directive == "endif") --conditional_depth_;
      if (line.directive == "extension" && is_intrinsics(line.arguments) && is_read())
        throw UserError(where + "#extension " + line.arguments +
                        " is not supported: what it adds to the language is not translated; leave it out");
      if (line.directive == "include") {
        include(file, line, where);
      } else if (line.directive == "version") {
        if (is_read()) version(line, where, main);
        blank(line);
      } else if (line.directive == "extension" && plain_extension(line.arguments).empty()) {
        blank(line);
      } else if (line.directive == "extension" && conditional_depth_ == outer_depth) {
        prologue_ += "#line " + std::to_string(line.number) + " " + quoted(file.shown) + "\n#extension " +
                     plain_extension(line.arguments) + "\n";
        blank(line);
      } else if (line.directive == "extension") {
        body_ += "#extension " + plain_extension(line.arguments) + ' ';
        blank(line);
      } else {
        body_ += with_file_index(line, index) + '\n';
        if (line.directive == "line" && names_string(line.arguments)) file_is_numbered_ = true;
      }
      code_seen_ = code_seen_ || line.code.find_first_not_of(" \t\v\f\n") != std::string::npos;
    }
  }

  ShaderSource finish(const std::string& name) {
    ShaderSource source;
    source.name = name;
    source.text = version_line_ + prologue_ + defines_ + body_;
    source.files = files_;
    source.builtin_files = builtin_files_;
    source.version = version_;
    source.es = es_;
    source.stage = stage_;
    return source;
  }

 private:
  // Whether a #line gives a number to what __FILE__ is from there on.
  static bool names_string(const std::string& arguments) {
    return arguments.find_first_of(" \t") != arguments.npos && arguments.find('"') == arguments.npos;
  }

  // GLSL's __FILE__ is a number, glslang's the name that #line gives: the number is written out, but where the author
  // gives one or only asks whether there is such a macro.
  std::string with_file_index(const SourceLine& line, const std::string& index) const {
    constexpr std::string_view word = "__FILE__";
    const std::string& text = line.text;
    const bool is_asked_for = line.directive == "ifdef" || line.directive == "ifndef" || line.directive == "undef";
    if (file_is_numbered_ || is_asked_for) return text;
    std::string result;
    std::size_t from = 0;
    for (std::size_t at = find_word(text, word); at != text.npos; at = find_word(text, word, from)) {
      std::size_t before = text.find_last_not_of(" \t(", at == 0 ? 0 : at - 1);
      if (before == text.npos) before = 0;
      constexpr std::string_view kDefined = "defined";
      const bool is_defined =
          before + 1 >= kDefined.size() && text.compare(before + 1 - kDefined.size(), kDefined.size(), kDefined) == 0;
      result += text.substr(from, at - from) + (is_defined ? std::string(word) : index);
      from = at + word.size();
    }
    return result + text.substr(from);
  }

  // The directives that ask for what has been done here already.
  static bool replaced_extension(const std::string& arguments) {
    for (const char* name :
         {"GL_GOOGLE_include_directive", "GL_GOOGLE_cpp_style_line_directive", "GL_ARB_shading_language_include"})
      if (arguments.compare(0, std::string(name).size(), name) == 0) return true;
    return false;
  }

  // What it declares would be glslang's alone: the lint's parser knows no such functions, nor does OpenGL.
  static bool is_intrinsics(const std::string& arguments) {
    return find_word(arguments, "GL_EXT_spirv_intrinsics") == 0 && find_word(arguments, "disable") == arguments.npos;
  }

  // Extensions that GLSL 4.50 has all of, without a name that glslang knows.
  static bool is_part_of_latest(const std::string& name) {
    constexpr std::string_view kPart =
        "GL_ARB_arrays_of_arrays GL_ARB_conservative_depth GL_AMD_conservative_depth GL_ARB_texture_query_levels "
        "GL_ARB_shader_precision GL_ARB_ES2_compatibility GL_ARB_ES3_compatibility GL_ARB_ES3_1_compatibility "
        "GL_EXT_texture_array";
    return find_word(kPart, name.substr(0, name.find_first_of(" \t"))) != kPart.npos;
  }

  // As glslang can bear it, empty where there is nothing to ask for: of `warn` it reads positions that it has not set,
  // and `all : disable` takes the extension that our #line needs; what it does not know it refuses to `require`. What
  // is left of `all` is what there is without it.
  static std::string plain_extension(const std::string& arguments) {
    const std::size_t colon = arguments.find(':');
    if (replaced_extension(arguments) || colon == arguments.npos) return replaced_extension(arguments) ? "" : arguments;
    const std::string name = arguments.substr(0, colon);
    const bool requires_one =
        find_word(arguments, "require") > colon && find_word(arguments, "require") != arguments.npos;
    const bool warns = find_word(arguments, "warn") > colon && find_word(arguments, "warn") != arguments.npos;
    const bool disables = find_word(arguments, "disable") > colon && find_word(arguments, "disable") != arguments.npos;
    if (find_word(name, "all") == 0 && (warns || disables)) return "";
    return warns || (requires_one && is_part_of_latest(name)) ? name + ": enable" : arguments;
  }

  static std::string quoted(const std::string& path) { return '"' + line_name(path) + '"'; }

  void line_directive(int next_line, const std::string& shown) {
    file_is_numbered_ = false;
    body_ += "#line " + std::to_string(next_line) + " " + quoted(shown) + "\n";
  }

  // A comment that begins or ends there has its other half elsewhere.
  void blank(const SourceLine& line) {
    if (line.comments.find("*/") != std::string::npos || line.comments.find("/*") != std::string::npos)
      body_ += line.comments + '\n';
    else
      body_.append(static_cast<std::size_t>(std::count(line.text.begin(), line.text.end(), '\n')) + 1, '\n');
  }

  // Whether the preprocessor reads what stands here; it has not been asked for what stands in no conditional.
  bool is_read() {
    if (conditional_depth_ <= 0) return true;
    constexpr int kMostQuestions = 1000;
    if (++questions_ > kMostQuestions)
      throw UserError(files_.back() + ": more than " + std::to_string(kMostQuestions) +
                      " #include lines within #if: put them outside");
    constexpr const char* kMark = "twinshade_reads_this";
    ShaderSource so_far = finish("");
    so_far.text += std::string("\n") + kMark + "\n";
    for (int i = 0; i < conditional_depth_; ++i) so_far.text += "#endif\n";
    return preprocess_untried(so_far).find(kMark) != std::string::npos;
  }

  void version(const SourceLine& line, const std::string& where, bool main) {
    if (!main) throw UserError(where + "#version in an included file: move it to the main file");
    if (!version_line_.empty()) throw UserError(where + "a second #version: leave one of them out");
    if (code_seen_)
      throw UserError(where + "#version must come first, before all but comments: move it to the top of the file");
    std::size_t digits = 0;
    while (digits < line.arguments.size() && std::isdigit(static_cast<unsigned char>(line.arguments[digits]))) ++digits;
    if (digits != 3) throw UserError(where + "#version wants a number such as 450, got \"" + line.arguments + "\"");
    const std::size_t after = line.arguments.find_first_not_of(" \t", digits);
    const std::string profile = after == std::string::npos ? "" : line.arguments.substr(after);
    if (!profile.empty() && profile != "core" && profile != "compatibility" && profile != "es")
      throw UserError(where + "#version " + line.arguments + ": the profile is core, compatibility or es");
    version_ = std::stoi(line.arguments.substr(0, digits));
    es_ = version_ == 100 || profile == "es";
    refuse_other_versions(where);
    version_line_ = "#version " + line.arguments + "\n";
  }

  // Before the preprocessor is asked anything, which has no answers in other versions.
  void refuse_other_versions(const std::string& where) const {
    const std::vector<int> known =
        es_ ? std::vector{300, 310, 320} : std::vector{330, 400, 410, 420, 430, 440, 450, 460};
    if (std::find(known.begin(), known.end(), version_) != known.end()) return;
    const std::string name = std::string("GLSL ") + (es_ ? "ES " : "") + std::to_string(version_);
    const std::string least = es_ ? "300 es" : "330", latest = es_ ? "320 es" : "460";
    if (version_ < known.front())
      throw UserError(where + name + " is not supported: write #version " + least + " or later");
    throw UserError(where + name + " is not known: write #version " + least + " to " + latest);
  }

  void include(const File& from, const SourceLine& line, const std::string& where) {
    if (!is_read()) return blank(line);
    const std::string& a = line.arguments;
    const bool quotes = a.size() > 2 && a.front() == '"' && a.back() == '"';
    const bool angles = a.size() > 2 && a.front() == '<' && a.back() == '>';
    if (!quotes && !angles) throw UserError(where + "#include wants \"file\", got " + (a.empty() ? "nothing" : a));
    const std::string wanted = a.substr(1, a.size() - 2);
    File file = find(from, wanted, where);
    if (line.comments.find("*/") != std::string::npos) body_ += line.comments + '\n';
    unite_with_builtin(file);
    const bool is_new = std::find(identities_.begin(), identities_.end(), file.identity) == identities_.end();
    if (is_new || is_list_of_macro_calls(file.text)) {
      if (++depth_ > kMostIncludes)
        throw UserError(where + "files are included more than " + std::to_string(kMostIncludes) + " deep");
      resolve(std::move(file));
      --depth_;
      if (body_.empty() || body_.back() != '\n') body_ += '\n';
    }
    line_directive(line.number + static_cast<int>(std::count(line.text.begin(), line.text.end(), '\n')) + 1,
                   from.shown);
  }

  File find(const File& from, const std::string& wanted, const std::string& where) const {
    std::string looked;
    if (from.builtin) {
      const std::string beside = (fs::path(from.folder) / wanted).lexically_normal().string();
      if (const auto text = builtin_shader(beside)) return builtin_file(beside, *text);
      looked = kBuiltinShown + from.folder;
    } else if (from.has_folder) {
      if (auto file = open_file(fs::path(from.folder) / wanted)) return *file;
      looked = from.folder.empty() ? "." : from.folder;
    }
    for (const std::string& folder : include_folders_) {
      if (folder.rfind(kBuiltinFolder, 0) == 0) {
        const std::string name = folder.substr(kBuiltinFolder.size()) + "/" + wanted;
        if (const auto text = builtin_shader(name)) return builtin_file(name, *text);
        continue;
      }
      if (auto file = open_file(fs::path(folder) / wanted)) return *file;
      looked += (looked.empty() ? "" : ", ") + folder;
    }
    const std::string normal = fs::path(wanted).lexically_normal().string();
    if (const auto text = builtin_shader(normal)) return builtin_file(normal, *text);
    throw UserError(where + "cannot include \"" + wanted + "\": not found in " + looked + (looked.empty() ? "" : ", ") +
                    "built-in shaders");
  }

  const std::vector<std::string>& include_folders_;
  const ShaderStage stage_;
  std::vector<std::string> identities_, files_;
  std::set<std::string> builtin_files_;
  std::string version_line_, prologue_, defines_, body_;
  int version_ = 450, depth_ = 0, conditional_depth_ = 0, questions_ = 0;
  bool es_ = false, code_seen_ = false, file_is_numbered_ = false;
};

}  // namespace

ShaderSource resolve_shader(const std::string& name, const std::string& main_text, const std::string& main_path,
                            const SourceOptions& options) {
  File file;
  file.shown = main_path;
  file.folder = fs::path(main_path).parent_path().string();
  file.identity = main_path;
  file.text = unix_lines(main_text);
  file.has_folder = !file.folder.empty() || fs::exists(main_path);
  // A text made by the program under a built-in's name includes its neighbours from the binary.
  if (main_path.compare(0, 8, "shaders/") == 0 && !fs::exists(main_path)) {
    file.builtin = true;
    file.folder = fs::path(main_path.substr(8)).parent_path().string();
  }
  Resolver resolver(stage_of(main_path), options);
  resolver.resolve(std::move(file));
  return resolver.finish(name);
}

void require_include_folder(const std::string& folder) {
  std::error_code code;
  if (folder.rfind("builtin:", 0) != 0 && !fs::is_directory(folder, code))
    throw UserError("--include " + folder + ": there is no such folder");
}

void require_define(const std::string& define) {
  const std::string name = define.substr(0, define.find('='));
  const auto refuse = [&](const std::string& why) { throw UserError("--define " + define + ": " + why); };
  if (name.empty() || !std::all_of(name.begin(), name.end(), is_word_character) ||
      std::isdigit(static_cast<unsigned char>(name[0])))
    refuse("wants NAME or NAME=VALUE, NAME of letters, digits and underscores");
  if (name.rfind("GL_", 0) == 0 || name.rfind("gl_", 0) == 0 || name.find("__") != name.npos || name == "defined")
    refuse("such names are GLSL's own");
  if (define.find_first_of("\r\n") != define.npos || define.back() == '\\') refuse("the value must be one line");
}

ShaderSource load_shader(const std::string& path, const SourceOptions& options) {
  // It stands in comments of generated code, in lines of tables and of messages.
  if (std::any_of(path.begin(), path.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; })) {
    std::string shown = path;
    for (char& c : shown)
      if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) c = '?';
    throw UserError(shown + ": the path has a control character in it: rename it");
  }
  refuse_large_file(path);
  const std::string text = read_file(path, kMostBytes);
  if (text.find('\0') != std::string::npos) throw UserError(path + ": not GLSL: it has zero bytes");
  return resolve_shader(fs::path(path).stem().string(), text, path, options);
}

ShaderSource load_fragment_shader(const std::string& path, const SourceOptions& options) {
  ShaderSource source = load_shader(path, options);
  if (source.stage == ShaderStage::compute)
    throw UserError(path +
                    ": a compute shader (.comp) is neither drawn nor checked: `twinshade translate` translates and "
                    "lints it, run_compute() runs it from C++");
  return source;
}

std::string source_hash(const ShaderSource& source) {
  Sha256 hash;
  hash.add(std::to_string(source.version) + (source.es ? " es\n" : "\n"));
  if (source.stage == ShaderStage::compute) hash.add("compute\n");
  static constexpr const char* kPrecisions[] = {"", "mediump\n", "half\n", "by line\n"};
  hash.add(kPrecisions[int(source.precision)]);
  hash.add(source.text);
  return hash.hex();
}

}  // namespace twinshade
