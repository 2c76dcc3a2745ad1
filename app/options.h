// Options that several verbs share, each declared, parsed and checked in one place.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <vector>

#include "cpu_shaders/runtime/shader_abi.h"
#include "cpu_shaders/shader_source.h"
#include "golden/pictures.h"
#include "lighting/visibility_bundle.h"
#include "raster/renderer.h"
#include "raster/tiled/entry.h"
#include "scenes/scene.h"

namespace CLI {
class App;
}

namespace twinshade {

// A verb of the command line: its CLI11 subcommand and what it does. run returns the exit code: 0 as it should be, 1 a
// mismatch, 2 some backend could not draw. Everything else is thrown.
struct Verb {
  CLI::App* command = nullptr;
  std::function<int()> run;
};

Verb add_list(CLI::App& app);
Verb add_bake(CLI::App& app);
Verb add_render(CLI::App& app);
Verb add_compare(CLI::App& app);
Verb add_translate(CLI::App& app);
Verb add_check(CLI::App& app);
Verb add_bench(CLI::App& app);
Verb add_experiment(CLI::App& app);
Verb add_frontier(CLI::App& app);
Verb add_choose(CLI::App& app);
Verb add_stability(CLI::App& app);
Verb add_eval(CLI::App& app);
Verb add_golden(CLI::App& app);
Verb add_mediump(CLI::App& app);
Verb add_profile(CLI::App& app);

// Every verb.
struct CommonOptions {
  std::string json;  // file, "-" for stdout, empty: none
  int threads = 0;   // 0: one per processor
  std::uint64_t seed = 1;
  bool seed_given = false;  // by --seed: a bundle file admits none
  bool quiet = false;
};

// How each case went, of verbs that judge: for CI services and for people.
struct ReportOptions {
  std::string junit, html;  // files, "-" for stdout, empty: none
  std::string annotate;     // the service, or empty
};

// Where shaders read their light from. automatic: lightmaps, or vertices where there are none, and volumes for
// techniques that read nothing else; all: each technique from everything that it can be read from.
enum class LightSource { automatic, lightmap, vertex, volume, all };

// What is drawn: all that goes into a bundle.
struct SubjectOptions {
  std::string scene = "courtyard";  // built-in name, model or bundle file
  std::uint32_t triangles = 0;      // refine a built-in scene to at least so many; 0: as it is
  std::string environment = "sky";
  double rotation_degrees = 0;
  bool clamp_radiance = false;
  std::uint32_t width = 1280, height = 800;
  std::optional<Camera> camera;  // eye, target and field of view of the user's; the rest is the scene's
  bool albedo = true, normal_map = true;
  std::uint32_t lightmap_size = 512, rays = 256;
  glm::ivec3 volume{16, 8, 16};  // probes
  std::uint32_t probe_rays = 512;
  std::string second_environment;  // blended into the first; empty: none
  double blend = 0.5;              // part of the second
  std::uint32_t visibility_rays = 512;
  VisibilityLighting visibility;   // its maps come from ShadingOptions
  std::vector<std::string> given;  // names of those options that were set: a bundle file admits none
};

// Which shaders draw it.
struct ShadingOptions {
  std::vector<std::string> techniques;  // "all" or names
  std::string shader;                   // a user's fragment shader, or empty
  SourceOptions source;                 // of that
  std::vector<std::string> uniforms;    // of that: "NAME=VALUE,..." (app/uniform_values.h)
  std::vector<std::string> textures;    // of that: "NAME=FILE" (app/texture_files.h)
  LightSource light = LightSource::automatic;
  std::uint32_t reference_rays = 1024;    // technique reference
  int reference_order = 0;                // SH order that the environment is cut to for it; 0: as it is
  std::vector<std::string> maps{"cube"};  // "all" or names, for techniques that look up tables
};

// How the CPU draws.
struct CpuOptions {
  std::optional<Isa> isa;
  std::optional<Number> number;
  Precision precision = Precision::full;  // --number mediump, float16: of the number type that is drawn with else
  bool emulates = false;                  // whether the verb takes those two
  int tile_size = 0;
};

void add_common_options(CLI::App& command, CommonOptions& options);
void add_subject_options(CLI::App& command, SubjectOptions& options);
// --technique and --map; once parsed, refuses what the chosen techniques or the shader do not read. Help says that a
// verb takes one of each unless its default is all.
void add_technique_option(CLI::App& command, ShadingOptions& options, const std::string& default_techniques);
// Whether a technique reads what an option says: --map, --order and --pca-metric are read by some only.
bool reads_option(const TechniqueInfo& technique, const std::string& option);
void add_light_option(CLI::App& command, ShadingOptions& options, bool one = false);
// --technique, --map, --light and --shader.
void add_shading_options(CLI::App& command, ShadingOptions& options, const std::string& default_techniques);
// --reference-rays and --reference-order.
void add_reference_options(CLI::App& command, ShadingOptions& options);
void add_attribute_option(CLI::App& command, AttributeMode& attributes);
// The same, or both.
void add_attribute_modes_option(CLI::App& command, std::vector<AttributeMode>& modes);
// --junit, --html and --annotate.
void add_report_options(CLI::App& command, ReportOptions& options);
// --gl-fma, and --no-host-fma for short.
void add_fma_option(CLI::App& command, bool& host_fma);
// --isa, --number and --lanes. isa_default: what is drawn with where --isa is not given, for the help.
void add_number_options(CLI::App& command, CpuOptions& options, const std::string& isa_default = "the best there is");
// The same and --tile.
void add_cpu_options(CLI::App& command, CpuOptions& options, const std::string& isa_default = "the best there is");
void add_count_option(CLI::App& command, const std::string& name, int& count,
                      const std::string& description);  // 1 to 1000
// A whole number; CLI11 takes -1 for the largest.
void add_whole_option(CLI::App& command, const std::string& name, const std::string& description, std::uint64_t least,
                      std::uint64_t most, std::function<void(std::uint64_t)> take);
// -I, --include: folders that exist; -D, --define.
void add_source_options(CLI::App& command, SourceOptions& options);
// The value of an option. UserError where it is no finite number.
double parse_real(const std::string& option, const std::string& text);
void add_time_limit_option(CLI::App& command, double& seconds);
// Of a command that has --output already.
void add_picture_options(CLI::App& command, PictureOptions& options);

// UserError for an option of the CPU or of OpenGL that was given and that none of the chosen machines has.
void require_machine_options(const CLI::App& command, const std::vector<std::string>& machines);

// UserError for an option of a file or folder to write, or of a file to read, whose name is empty, as of a script's
// variable that is not set: it is not the same as to leave the option out.
void require_names(const CLI::App& command);

// Sets the thread count; to be called once the options are parsed.
void apply(const CommonOptions& options);

using tiled::isa_name;
using tiled::number_name;
const char* attribute_mode_name(AttributeMode attributes);
Number parse_number(const std::string& name);
// "mediump", "float16": number types that are emulated by others. None where the name is another one.
std::optional<Precision> parse_precision(const std::string& name);
// The two names.
const std::vector<std::string>& precision_names();

}  // namespace twinshade
