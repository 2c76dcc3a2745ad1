#include "app/golden/drawing.h"

#include <CLI/CLI.hpp>

#include <algorithm>
#include <filesystem>
#include <iterator>

#include "app/option_rules.h"
#include "base/error.h"
#include "base/names.h"
#include "base/utf8.h"
#include "scenes/environment.h"
#include "scenes/scene.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScene = "scene";
constexpr const char* kTechnique = "technique";
constexpr const char* kShader = "shader";
constexpr const char* kTexture = "texture";
constexpr const char* kMap = "map";
constexpr const char* kLight = "light";

// Of all options that may be kept, without dashes, in the order of the help.
const std::vector<std::string>& drawing_keys() {
  static const std::vector<std::string> keys = [] {
    CLI::App command;
    DrawingOptions options;
    add_drawing_options(command, options);
    std::vector<std::string> names;
    for (const CLI::Option* option : command.get_options())
      if (option->get_lnames().empty())
        names.push_back(option->get_name(true));
      else if (option->get_lnames().front() != "help")
        names.push_back(option->get_lnames().front());
    names.push_back("seed");
    return names;
  }();
  return keys;
}

std::string option_of(const std::string& key) { return key == kScene ? key : "--" + key; }

// Whether the value of an option is a file's or folder's name, and not the name of something built in.
bool is_path(const std::string& key, const std::string& value) {
  const auto none_of = [&](const std::vector<std::string>& built_in) {
    return std::find(built_in.begin(), built_in.end(), value) == built_in.end();
  };
  if (key == kScene) return none_of(scene_names());
  if (key == "env" || key == "env2") return none_of(environment_names());
  return key == kShader || (key == "include" && value.rfind("builtin:", 0) != 0);
}

// Where in the value of an option the name of a file or folder begins; npos where it has none.
std::size_t path_in(const std::string& key, const std::string& value) {
  if (key != kTexture) return is_path(key, value) ? 0 : value.npos;
  const std::size_t equals = value.find('=');
  return equals == value.npos ? value.npos : equals + 1;
}

// The first folder of an absolute path; empty for the root.
fs::path below_root(const fs::path& path) {
  const auto first = std::next(path.begin());
  return first == path.end() ? fs::path() : *first;
}

// A path as seen from `folder`. Without a look at links where that leads to the same file: the folder may move with all
// that is about it, and where a link leads need not. An absolute path that has but the root in common with the folder's
// stays one: such files are in that place on every machine, and the folder is not.
std::string seen_from(const std::string& folder, const std::string& key, const std::string& path) {
  std::error_code code;
  const fs::path from = fs::absolute(folder, code).lexically_normal();
  const fs::path whole = fs::absolute(path, code).lexically_normal();
  const bool apart = fs::path(path).is_absolute() && below_root(whole) != below_root(from);
  fs::path relative = apart ? whole : whole.lexically_relative(from / "");
  if (fs::exists(folder, code) && fs::exists(whole, code) && !fs::equivalent(from / relative, whole, code))
    relative = fs::relative(whole, from, code);
  std::string text = code || relative.empty() ? path : relative.generic_string();
  if (with_characters_alone(text) != text)
    throw UserError(path + ": the path has a control character, or bytes that are no UTF-8: rename it");
  return is_path(key, text) ? text : "./" + text;
}

// The same from the current folder. A name without folder and ending, where there is no such file, is one that is not
// built in any more.
std::string seen_from_here(const std::string& folder, const std::string& path) {
  std::error_code code;
  const fs::path there = (fs::path(folder) / path).lexically_normal();
  return path.find_first_of("/.") == std::string::npos && !fs::exists(there, code) ? path : there.string();
}

void erase(GoldenDrawing& drawing, const std::string& key) {
  std::erase_if(drawing, [&](const auto& option) { return option.first == key; });
}

void set(GoldenDrawing& drawing, const std::string& key, const std::string& value) {
  for (auto& [there, values] : drawing)
    if (there == key) {
      values = {value};
      return;
    }
  drawing.emplace_back(key, std::vector<std::string>{value});
}

std::vector<std::string> chosen_map_names(const ShadingOptions& shading) {
  std::vector<std::string> names;
  for (const std::string& name : shading.maps)
    for (const SphereMapInfo& map : sphere_maps())
      if (name == "all" || map.name == find_sphere_map(name).name) names.emplace_back(map.name);
  return names;
}

// The places that a technique is to read its light from; "" where it is not said.
std::vector<std::string> chosen_lights(const TechniqueInfo& technique, const ShadingOptions& shading) {
  if (shading.light != LightSource::all) return {""};
  std::vector<std::string> names;
  for (const CoefficientStorage storage :
       {CoefficientStorage::lightmap, CoefficientStorage::vertex, CoefficientStorage::volume})
    if (can_read(technique, storage)) names.emplace_back(storage_name(storage));
  return names;
}

}  // namespace

void add_drawing_options(CLI::App& command, DrawingOptions& options) {
  add_subject_options(command, options.subject);
  add_shading_options(command, options.shading, "all");
  require_one_shader(command);
  require_second_environment(command);
}

GoldenDrawing given_drawing(const CLI::App& command, const std::string& folder) {
  GoldenDrawing drawing;
  for (const std::string& key : drawing_keys()) {
    const CLI::Option* option = command.get_option(option_of(key));
    if (option->count() == 0) continue;
    std::vector<std::string> values = option->results();
    for (std::string& value : values)
      if (const std::size_t at = path_in(key, value); at != value.npos)
        value = value.substr(0, at) + seen_from(folder, key, value.substr(at));
    drawing.emplace_back(key, std::move(values));
  }
  return drawing;
}

std::string shader_path(const GoldenDrawing& drawing, const std::string& folder) {
  for (const auto& [key, values] : drawing)
    if (key == kShader && values.size() == 1) return seen_from_here(folder, values.front());
  return "";
}

DrawingOptions parse_drawing(const GoldenDrawing& drawing, const std::string& folder) {
  DrawingOptions options;
  CLI::App command;
  add_drawing_options(command, options);
  std::uint64_t seed = options.common.seed;
  add_whole_option(command, "--seed", "", 0, UINT64_MAX, [&](std::uint64_t value) { seed = value; });
  for (CLI::Option* option : command.get_options())
    if (option->nonpositional()) option->allow_extra_args(false);

  std::vector<std::string> arguments, positional;
  for (const auto& [key, values] : drawing) {
    const std::vector<std::string>& keys = drawing_keys();
    if (std::find(keys.begin(), keys.end(), key) == keys.end())
      throw UserError("\"draw\": " + unknown_name_message("option", key, keys));
    if (key == kScene && values.size() != 1) throw UserError("\"draw\": \"scene\" must be one text");
    for (const std::string& value : values) {
      if (value.empty()) throw UserError("\"draw\": \"" + key + "\" is empty");
      const std::size_t at = path_in(key, value);
      const std::string seen =
          at == value.npos ? value : value.substr(0, at) + seen_from_here(folder, value.substr(at));
      if (key == kScene)
        positional.push_back(seen);
      else
        arguments.push_back("--" + key + "=" + seen);
    }
  }
  arguments.emplace_back("--");
  arguments.insert(arguments.end(), positional.begin(), positional.end());
  std::reverse(arguments.begin(), arguments.end());  // as CLI11 wants them
  try {
    command.parse(arguments);
  } catch (const CLI::ParseError& error) {
    throw UserError(std::string("\"draw\": ") + error.what());
  }
  options.common.seed = seed;
  return options;
}

std::vector<GoldenDrawing> single_drawings(const GoldenDrawing& drawing, const ShadingOptions& shading) {
  if (!shading.shader.empty()) return {drawing};
  std::vector<GoldenDrawing> singles;
  for (const TechniqueInfo* technique : chosen_techniques(shading)) {
    GoldenDrawing of_technique = drawing;
    set(of_technique, kTechnique, std::string(technique->name));
    for (const std::string& key : drawing_keys())
      if (!reads_option(*technique, option_of(key))) erase(of_technique, key);
    const std::vector<std::string> maps =
        reads_sphere_map(*technique) ? chosen_map_names(shading) : std::vector<std::string>{""};
    for (const std::string& map : maps)
      for (const std::string& light : chosen_lights(*technique, shading)) {
        GoldenDrawing single = of_technique;
        if (!map.empty()) set(single, kMap, map);
        if (!light.empty()) set(single, kLight, light);
        singles.push_back(std::move(single));
      }
  }
  return singles;
}

bool same_drawing(GoldenDrawing a, GoldenDrawing b) {
  std::sort(a.begin(), a.end());
  std::sort(b.begin(), b.end());
  return a == b;
}

}  // namespace twinshade
