#include "app/options.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <iterator>
#include <utility>

#include "app/subject.h"
#include "base/error.h"
#include "base/names.h"
#include "base/parallel.h"
#include "cpu_shaders/machine.h"
#include "cpu_shaders/shader_source.h"
#include "scenes/scene_limits.h"

namespace twinshade {
namespace {

const char* const kNumberNames[] = {number_name(Number::lanes4), number_name(Number::lanes8),
                                    number_name(Number::lanes16), number_name(Number::scalar),
                                    number_name(Number::float64)};  // by the enumeration's values
constexpr const char* kAttributeModeNames[] = {"exact", "native"};
constexpr const char* kLightNames[] = {"auto", "lightmap", "vertex", "volume", "all"};
constexpr const char* kTonemapNames[] = {"none", "reinhard", "aces"};

constexpr std::uint32_t kLargestFrame = 16384;
constexpr std::uint32_t kLargestLightmap = 4096;
constexpr std::uint32_t kMostRays = 65536;
constexpr int kMostProbes = 256;
constexpr int kWidestMap = 4096;
constexpr int kMostThreads = 1024;
constexpr std::uint32_t kMostTriangles = 1u << 27;  // as scenes/patch_mesh.h

// Index of `value` in `names`; UserError with the nearest ones where there is none.
template <std::size_t count>
std::size_t index_of(const char* const (&names)[count], const std::string& kind, const std::string& value) {
  for (std::size_t i = 0; i < count; ++i)
    if (value == names[i]) return i;
  throw UserError(unknown_name_message(kind, value, {std::begin(names), std::end(names)}));
}

template <class T>
bool parse_whole(std::string_view text, T& value) {
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  return error == std::errc() && end == text.data() + text.size();
}

template <class T>
T parse_between(const std::string& option, const std::string& text, T least, T most) {
  T value{};
  if (!parse_whole(text, value) || value < least || value > most)
    throw UserError(fmt::format("{} {}: must be a whole number from {} to {}", option, text, least, most));
  return value;
}

void parse_size(const std::string& text, std::uint32_t& width, std::uint32_t& height) {
  const std::size_t cross = text.find('x');
  const std::string_view all(text);
  if (cross == std::string::npos || !parse_whole(all.substr(0, cross), width) ||
      !parse_whole(all.substr(cross + 1), height) || width < 1 || height < 1 || width > kLargestFrame ||
      height > kLargestFrame)
    throw UserError(
        fmt::format("--size {}: must be WIDTHxHEIGHT, each from 1 to {}, as 1280x800", text, kLargestFrame));
}

glm::ivec3 parse_volume(const std::string& text) {
  glm::ivec3 size(0);
  std::string_view rest(text);
  bool good = true;
  for (int axis = 0; axis < 3 && good; ++axis) {
    const std::size_t cross = axis < 2 ? rest.find('x') : rest.size();
    good = cross != std::string_view::npos && parse_whole(rest.substr(0, cross), size[axis]) && size[axis] >= 1 &&
           size[axis] <= kMostProbes;
    if (good) rest.remove_prefix(std::min(cross + 1, rest.size()));
  }
  if (!good)
    throw UserError(
        fmt::format("--volume {}: must be NXxNYxNZ probes, each from 1 to {}, as 16x8x16", text, kMostProbes));
  return size;
}

Camera parse_camera(const std::string& text) {
  std::array<double, 7> v{};
  std::string_view rest(text);
  bool good = true;
  for (std::size_t i = 0; i < v.size() && good; ++i) {
    const std::size_t comma = i + 1 < v.size() ? rest.find(',') : rest.size();
    good = comma != std::string_view::npos && parse_whole(rest.substr(0, comma), v[i]) && std::isfinite(v[i]);
    if (good) rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  if (!good)
    throw UserError("--camera " + text +
                    ": must be seven numbers EYEX,EYEY,EYEZ,TARGETX,TARGETY,TARGETZ,FOV (degrees)");
  Camera camera;
  camera.eye = {v[0], v[1], v[2]};
  camera.target = {v[3], v[4], v[5]};
  camera.vertical_fov_degrees = v[6];
  if (std::any_of(v.begin(), v.begin() + 6, [](double x) { return std::fabs(x) > kLargestCoordinate; }))
    throw UserError("--camera " + text + ": lies farther than 1e15 from the origin; give smaller coordinates");
  if (camera.eye == camera.target) throw UserError("--camera " + text + ": eye and target are the same point");
  if (!(v[6] > 0 && v[6] < 180))
    throw UserError("--camera " + text + ": field of view must be between 0 and 180 degrees");
  return camera;
}

bool parse_switch(const std::string& option, const std::string& text) {
  if (text != "on" && text != "off") throw UserError(option + " " + text + ": must be on or off");
  return text == "on";
}

// Options that only some techniques read.
struct ReadByTechniques {
  const char* option;
  bool (*reads)(const TechniqueInfo&);
};
bool has_components(const TechniqueInfo& technique) { return technique.weights == VisibilityWeights::pca; }
constexpr ReadByTechniques kReadByTechniques[] = {
    {"--map", reads_sphere_map}, {"--order", has_components}, {"--pca-metric", has_components}};

bool is_given(const CLI::App& command, const char* option) {
  const CLI::Option* there = command.get_option_no_throw(option);
  return there && there->count() > 0;
}

// What none of the chosen techniques reads is refused. A user's shader may name the coefficients of any.
void require_read_by_technique(const CLI::App& command, const ShadingOptions& options) {
  const std::vector<std::string>& names = options.techniques;
  if (!options.shader.empty() || std::find(names.begin(), names.end(), "all") != names.end()) return;
  for (const auto& [option, reads] : kReadByTechniques) {
    if (!is_given(command, option) || std::any_of(names.begin(), names.end(), [reads = reads](const auto& name) {
          return name != kReferenceTechnique && reads(find_technique(name));
        }))
      continue;
    std::string readers;
    for (const TechniqueInfo& technique : techniques())
      if (reads(technique)) readers += (readers.empty() ? "" : ", ") + std::string(technique.name);
    throw UserError(fmt::format("{}: not read by {}: leave it out, or draw with a technique that reads it: {}", option,
                                fmt::join(names, ","), readers));
  }
}

// A user's shader names what it reads its light from; from vertices or lightmaps is the same text.
void require_light_of_shader(const ShadingOptions& options) {
  if (options.shader.empty() || (options.light != LightSource::volume && options.light != LightSource::all)) return;
  throw UserError(
      fmt::format("--light {}: a shader of your own says itself what it reads, coefficients_BASIS or volume_BASIS: "
                  "leave it out",
                  kLightNames[std::size_t(options.light)]));
}

// An option whose text is parsed by `parse`, which throws UserError.
void add_parsed(CLI::App& command, const std::string& name, const std::string& shape, const std::string& description,
                std::function<void(const std::string&)> parse) {
  command.add_option_function<std::string>(name, std::move(parse), description)->type_name(shape);
}

// Of the verbs, those that draw with one technique alone have one as their default.
bool draws_one(const std::string& default_techniques) { return default_techniques != "all"; }

}  // namespace

void add_common_options(CLI::App& command, CommonOptions& options) {
  command.add_option("--json", options.json, "write the results as JSON; - for stdout")->type_name("FILE");
  add_parsed(command, "--threads", "N", "threads of the CPU and of llvmpipe (default: one per processor)",
             [&](const std::string& text) { options.threads = parse_between("--threads", text, 1, kMostThreads); });
  add_parsed(command, "--seed", "N", "seed of everything random (default: 1)", [&](const std::string& text) {
    options.seed = parse_between<std::uint64_t>("--seed", text, 0, UINT64_MAX);
    options.seed_given = true;
  });
  command.add_flag("--quiet", options.quiet, "no progress and no notes");
}

void add_subject_options(CLI::App& command, SubjectOptions& options) {
  const auto given = [&options](const char* name, auto parse) {
    return [&options, name, parse](const std::string& text) {
      options.given.emplace_back(name);
      parse(text);
    };
  };
  command.add_option("scene", options.scene, "built-in scene, model file or bundle file (default: courtyard)")
      ->type_name("SCENE");
  add_parsed(command, "--env", "E", "built-in environment or lat-long .hdr/.exr (default: sky)",
             given("--env", [&](const std::string& text) { options.environment = text; }));
  add_parsed(command, "--env-rotation", "DEG", "turns the environment about the vertical",
             given("--env-rotation",
                   [&](const std::string& text) { options.rotation_degrees = parse_real("--env-rotation", text); }));
  command.add_flag_callback(
      "--clamp-radiance",
      [&options] {
        options.given.emplace_back("--clamp-radiance");
        options.clamp_radiance = true;
      },
      "accept environments with NaN, infinite, negative or too large (1e30) radiance");
  add_parsed(command, "--size", "WxH", "size of the frame (default: 1280x800)",
             given("--size", [&](const std::string& text) { parse_size(text, options.width, options.height); }));
  add_parsed(command, "--camera", "EYE,TARGET,FOV",
             "seven numbers; vertical field of view in degrees; up is +Y, -Z for views straight up or down (default: "
             "the scene's)",
             given("--camera", [&](const std::string& text) { options.camera = parse_camera(text); }));
  add_parsed(command, "--triangles", "N", "refine a built-in scene to at least so many triangles",
             given("--triangles", [&](const std::string& text) {
               options.triangles = parse_between<std::uint32_t>("--triangles", text, 1, kMostTriangles);
             }));
  add_parsed(command, "--lightmap", "N", "lightmap texels each way (default: 512)",
             given("--lightmap", [&](const std::string& text) {
               options.lightmap_size = parse_between<std::uint32_t>("--lightmap", text, 1, kLargestLightmap);
             }));
  add_parsed(command, "--rays", "N", "rays per texel or vertex (default: 256)",
             given("--rays", [&](const std::string& text) {
               options.rays = parse_between<std::uint32_t>("--rays", text, 1, kMostRays);
             }));
  add_parsed(command, "--volume", "NXxNYxNZ", "probes of the irradiance volume (default: 16x8x16)",
             given("--volume", [&](const std::string& text) { options.volume = parse_volume(text); }));
  add_parsed(command, "--probe-rays", "N", "rays per probe (default: 512)",
             given("--probe-rays", [&](const std::string& text) {
               options.probe_rays = parse_between<std::uint32_t>("--probe-rays", text, 1, kMostRays);
             }));
  add_parsed(command, "--env2", "E", "second environment, blended into the first by --blend",
             given("--env2", [&](const std::string& text) { options.second_environment = text; }));
  add_parsed(command, "--blend", "F", "part of the second environment, 0 to 1 (default: 0.5)",
             given("--blend", [&](const std::string& text) {
               options.blend = parse_real("--blend", text);
               if (!(options.blend >= 0 && options.blend <= 1))
                 throw UserError("--blend " + text + ": must be from 0 to 1");
             }));
  add_parsed(command, "--map-width", "N",
             "texels across a layer of the tables' sphere map (default: 32, of octahedral maps 33)",
             given("--map-width", [&](const std::string& text) {
               options.visibility.map_width = parse_between("--map-width", text, 1, kWidestMap);
             }));
  add_parsed(command, "--order", "N", "order of the visibility that pca techniques take components of (default: 6)",
             given("--order",
                   [&](const std::string& text) { options.visibility.order = parse_between("--order", text, 2, 6); }));
  add_parsed(
      command, "--pca-metric", "surface|visibility|irradiance",
      "what components keep most of: what surfaces show of any light, visibility all around, or irradiance under this "
      "light (default: surface)",
      given("--pca-metric", [&](const std::string& text) { options.visibility.metric = find_pca_metric(text); }));
  add_parsed(command, "--visibility-rays", "N", "directions over the sphere per texel or vertex (default: 512)",
             given("--visibility-rays", [&](const std::string& text) {
               options.visibility_rays = parse_between<std::uint32_t>("--visibility-rays", text, 1, kMostRays);
             }));
  add_parsed(command, "--visibility-storage", "float32|half|unorm8",
             "how visibility's weights are kept (default: float32)",
             given("--visibility-storage",
                   [&](const std::string& text) { options.visibility.storage = find_texel_storage(text); }));
  add_parsed(command, "--visibility-packing", "layers|dx9",
             "weights and tables in texture arrays, or four values a texel in one texture each (default: layers)",
             given("--visibility-packing",
                   [&](const std::string& text) { options.visibility.packing = find_texture_packing(text); }));
  add_parsed(command, "--albedo", "on|off", "materials' colours (default: on)",
             given("--albedo", [&](const std::string& text) { options.albedo = parse_switch("--albedo", text); }));
  add_parsed(
      command, "--normal-map", "on|off", "materials' normal maps (default: on)",
      given("--normal-map", [&](const std::string& text) { options.normal_map = parse_switch("--normal-map", text); }));
}

void add_technique_option(CLI::App& command, ShadingOptions& options, const std::string& default_techniques) {
  const bool one = draws_one(default_techniques);
  options.techniques = {default_techniques};
  command
      .add_option("--technique", options.techniques,
                  (one ? "technique (default: " : "techniques, or all (default: ") + default_techniques + ")")
      ->delimiter(',')
      ->type_name(one ? "T" : "T,...");
  command
      .add_option("--map", options.maps,
                  one ? "sphere map of a technique that looks up tables (default: cube)"
                      : "sphere maps of techniques that look up tables, or all (default: cube)")
      ->delimiter(',')
      ->type_name(one ? "M" : "M,...");
  command.parse_complete_callback([&command, &options] {
    require_read_by_technique(command, options);
    require_light_of_shader(options);
  });
}

bool reads_option(const TechniqueInfo& technique, const std::string& option) {
  return std::all_of(std::begin(kReadByTechniques), std::end(kReadByTechniques),
                     [&](const ReadByTechniques& some) { return option != some.option || some.reads(technique); });
}

void add_light_option(CLI::App& command, ShadingOptions& options, bool one) {
  add_parsed(command, "--light", one ? "auto|lightmap|vertex|volume" : "auto|lightmap|vertex|volume|all",
             one ? "where the technique reads its light from (default: auto)"
                 : "where techniques read their light from; all: from each that they can (default: auto)",
             [&](const std::string& text) { options.light = LightSource(index_of(kLightNames, "light", text)); });
}

void add_shading_options(CLI::App& command, ShadingOptions& options, const std::string& default_techniques) {
  add_technique_option(command, options, default_techniques);
  add_light_option(command, options, draws_one(default_techniques));
  command.add_option("--shader", options.shader, "draw with this fragment shader instead of a technique")
      ->type_name("MY.frag");
  add_source_options(command, options.source);
  command
      .add_option("--uniform", options.uniforms,
                  "value of a uniform of that shader's own, numbers with commas between; again for several")
      ->type_name("NAME=VALUE,...");
  command.add_option("--texture", options.textures, "picture for a sampler2D of that shader's own; again for several")
      ->type_name("NAME=FILE");
  for (const char* option : {"--include", "--define", "--uniform", "--texture"})
    command.get_option(option)->needs(command.get_option("--shader"));
}

void add_reference_options(CLI::App& command, ShadingOptions& options) {
  add_parsed(command, "--reference-rays", "N", "rays per pixel of technique reference (default: 1024)",
             [&](const std::string& text) {
               options.reference_rays = parse_between<std::uint32_t>("--reference-rays", text, 1, kMostRays);
             });
  add_parsed(
      command, "--reference-order", "N",
      "light technique reference by the environment's SH of this order (default: 0, the environment itself)",
      [&](const std::string& text) { options.reference_order = parse_between("--reference-order", text, 0, 6); });
}

void add_attribute_option(CLI::App& command, AttributeMode& attributes) {
  add_parsed(command, "--attributes", "exact|native", "how attributes are interpolated (default: exact)",
             [&](const std::string& text) {
               attributes = AttributeMode(index_of(kAttributeModeNames, "attribute mode", text));
             });
}

void add_attribute_modes_option(CLI::App& command, std::vector<AttributeMode>& modes) {
  add_parsed(command, "--attributes", "exact|native|both", "how the CPU interpolates attributes (default: both)",
             [&](const std::string& text) {
               if (text != "both") modes = {AttributeMode(index_of(kAttributeModeNames, "attribute mode", text))};
             });
}

void add_report_options(CLI::App& command, ReportOptions& options) {
  command.add_option("--junit", options.junit, "write the results as JUnit XML; - for stdout")->type_name("FILE");
  command.add_option("--html", options.html, "write a page for people, with pictures of what differs; - for stdout")
      ->type_name("FILE");
  add_parsed(command, "--annotate", "github",
             "name what did not pass in the form that a service shows beside the source", [&](const std::string& text) {
               if (text != "github") throw UserError("--annotate " + text + ": must be github");
               options.annotate = text;
             });
}

void add_fma_option(CLI::App& command, bool& host_fma) {
  add_parsed(command, "--gl-fma", "on|off",
             "fused multiply-add within llvmpipe (default: on); off leaves it SSE4.1, whose vectors are of 128 bits: "
             "slower",
             [&](const std::string& text) { host_fma = parse_switch("--gl-fma", text); });
  command
      .add_flag_callback(
          "--no-host-fma", [&host_fma] { host_fma = false; }, "short for --gl-fma off")
      ->excludes(command.get_option("--gl-fma"));
}

void add_number_options(CLI::App& command, CpuOptions& options, const std::string& isa_default) {
  add_parsed(command, "--isa", "baseline|avx2|avx512",
             "instruction set of the CPU's shading (default: " + isa_default + ")",
             [&](const std::string& text) { options.isa = Isa(index_of(kIsaNames, "instruction set", text)); });
  std::string numbers = fmt::format("{}", fmt::join(kNumberNames, "|"));
  if (options.emulates) numbers += fmt::format("|{}", fmt::join(precision_names(), "|"));
  add_parsed(command, "--number", numbers, "number type of the CPU's shading", [&](const std::string& text) {
    if (const std::optional<Precision> precision = parse_precision(text)) {
      if (!options.emulates)
        throw UserError("--number " + text +
                        ": halves have other bits and another speed by design; twinshade render and eval compute them, "
                        "twinshade mediump tells which lines stand them");
      options.precision = *precision;
      return;
    }
    options.number = parse_number(text);
  });
  add_parsed(command, "--lanes", "4|8|16", "short for --number lanesN", [&](const std::string& text) {
    if (text != "4" && text != "8" && text != "16") throw UserError("--lanes " + text + ": must be 4, 8 or 16");
    options.number = parse_number("lanes" + text);
  });
  command.get_option("--lanes")->excludes(command.get_option("--number"));
}

void add_cpu_options(CLI::App& command, CpuOptions& options, const std::string& isa_default) {
  add_number_options(command, options, isa_default);
  add_parsed(command, "--tile", "16|32|64|128",
             "tile size of the CPU (default: 128 where threads have many such tiles, else 64)",
             [&](const std::string& text) {
               if (text != "16" && text != "32" && text != "64" && text != "128")
                 throw UserError("--tile " + text + ": must be 16, 32, 64 or 128");
               parse_whole(text, options.tile_size);
             });
}

void add_count_option(CLI::App& command, const std::string& name, int& count, const std::string& description) {
  add_parsed(command, name, "N", fmt::format("{} (default: {})", description, count),
             [name, &count](const std::string& text) { count = parse_between(name, text, 1, 1000); });
}

void add_whole_option(CLI::App& command, const std::string& name, const std::string& description, std::uint64_t least,
                      std::uint64_t most, std::function<void(std::uint64_t)> take) {
  add_parsed(command, name, "N", description, [name, least, most, take = std::move(take)](const std::string& text) {
    take(parse_between(name, text, least, most));
  });
}

double parse_real(const std::string& option, const std::string& text) {
  double value = 0;
  if (!parse_whole(text, value) || !std::isfinite(value))
    throw UserError(fmt::format("{} {}: must be a finite number", option, text));
  return value;
}

void add_source_options(CLI::App& command, SourceOptions& options) {
  command
      .add_option("-I,--include", options.include_folders, "folder to look for included files in; again for several")
      ->each(require_include_folder)
      ->type_name("DIR");
  command
      .add_option("-D,--define", options.defines,
                  "macro in front of the shader's text, 1 without a value; again for several")
      ->each(require_define)
      ->type_name("NAME[=VALUE]");
}

void add_time_limit_option(CLI::App& command, double& seconds) {
  add_parsed(command, "--time-limit", "SECONDS", "for each frame that OpenGL draws (default: 60)",
             [&](const std::string& text) {
               seconds = parse_real("--time-limit", text);
               if (!(seconds > 0)) throw UserError("--time-limit " + text + ": must be more than 0");
             });
}

void add_picture_options(CLI::App& command, PictureOptions& options) {
  add_parsed(command, "--exposure", "STOPS", "exposure of PNG pictures (default: 0)",
             [&](const std::string& text) { options.exposure = parse_real("--exposure", text); });
  add_parsed(command, "--tonemap", "none|reinhard|aces", "tone curve of PNG pictures (default: reinhard)",
             [&](const std::string& text) { options.tonemap = Tonemap(index_of(kTonemapNames, "tone curve", text)); });
  for (const char* option : {"--exposure", "--tonemap"})
    command.get_option(option)->needs(command.get_option("--output"));
}

void require_machine_options(const CLI::App& command, const std::vector<std::string>& machines) {
  const auto has = [&](const char* name) {
    return std::find(machines.begin(), machines.end(), name) != machines.end();
  };
  const auto require = [&](bool meant, const char* option, const char* owner, const char* name) {
    if (!meant && is_given(command, option))
      throw UserError(fmt::format("{}: {} alone has it; leave it out, or name {} in --on", option, owner, name));
  };
  for (const char* option : {"--isa", "--number", "--lanes", "--tile"}) require(has("cpu"), option, "the cpu", "cpu");
  for (const char* option : {"--gl-fma", "--no-host-fma"})
    require(has("egl") || has("osmesa") || has("softpipe"), option, "Mesa on the processor", "egl, osmesa or softpipe");
  require(machines.size() > (has("cpu") ? 1 : 0), "--time-limit", "OpenGL", "egl, osmesa, softpipe or gpu");
}

void require_names(const CLI::App& command) {
  const auto require = [&](const char* name, const char* use) {
    const CLI::Option* option = command.get_option_no_throw(name);
    if (option && option->count() > 0 && option->as<std::string>().empty())
      throw UserError(fmt::format("{} '': the name is empty; name the {} to {}", name,
                                  option->get_type_name() == "DIR" ? "folder" : "file", use));
  };
  for (const char* name : {"-o", "--json", "--junit", "--html"}) require(name, "write");
  for (const char* name : {"--shader", "--cases", "--inputs", "--env2"}) require(name, "read, or leave the option out");
}

void apply(const CommonOptions& options) {
  set_thread_count(options.threads);
  machine_isa();  // a wrong TWINSHADE_ISA is said before any work
}

const char* attribute_mode_name(AttributeMode attributes) { return kAttributeModeNames[std::size_t(attributes)]; }

const std::vector<std::string>& precision_names() {
  static const std::vector<std::string> names{"mediump", "float16"};
  return names;
}

std::optional<Precision> parse_precision(const std::string& name) {
  if (name == precision_names()[0]) return Precision::mediump;
  if (name == precision_names()[1]) return Precision::half;
  return std::nullopt;
}

Number parse_number(const std::string& name) { return Number(index_of(kNumberNames, "number type", name)); }

}  // namespace twinshade
