// list: what there is to draw, to draw with and to draw on.
#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <algorithm>
#include <memory>

#include "app/machines.h"
#include "app/output.h"
#include "app/provenance.h"
#include "app/report/table.h"
#include "app/subject.h"
#include "base/error.h"
#include "base/names.h"
#include "base/parallel.h"
#include "cpu_shaders/machine.h"
#include "experiments/basis_cost.h"
#include "lighting/registry.h"
#include "lighting/sphere_maps.h"
#include "scenes/environment.h"
#include "scenes/scene.h"

namespace twinshade {
namespace {

// One kind of thing: a table for people, an array for programs.
struct Listing {
  Table table;
  Json json = Json::array();
};

const char* domain_name(Domain domain) {
  return domain == Domain::hemisphere ? "hemisphere" : domain == Domain::sphere ? "sphere" : "either";
}

Listing list_maps() {
  Listing listing;
  listing.table.column("map");
  listing.table.column("layers", Table::Align::right);
  listing.table.column("source");
  for (const SphereMapInfo& map : sphere_maps()) {
    const std::string name(map.name), source(map.source);
    listing.table.row({name, std::to_string(map.layers), source});
    listing.json.push_back({{"name", name},
                            {"layers", map.layers},
                            {"file", "shaders/sphere_map/" + std::string(map.file)},
                            {"source", source}});
  }
  return listing;
}

Listing list_techniques() {
  Listing listing;
  listing.table.column("technique");
  listing.table.column("coefficients", Table::Align::right);
  listing.table.column("domain");
  listing.table.column("linear");
  listing.table.column("source");
  const auto add_plain = [&](const std::string& name, const Json& file, const std::string& source) {
    listing.table.row({name, "-", "-", "-", source});
    listing.json.push_back({{"name", name},
                            {"basis", false},
                            {"coefficients", nullptr},
                            {"domain", nullptr},
                            {"linear", nullptr},
                            {"file", file},
                            {"source", source}});
  };
  for (const TechniqueInfo& technique : techniques()) {
    const std::string name(technique.name), source(technique.source), file(technique.file);
    if (technique.is_basis) {
      const std::string domain = domain_name(technique.domain);
      listing.table.row({name, std::to_string(technique.count), domain, technique.linear ? "yes" : "no", source});
      listing.json.push_back({{"name", name},
                              {"basis", true},
                              {"coefficients", technique.count},
                              {"domain", domain},
                              {"linear", technique.linear},
                              {"file", "shaders/basis/" + file},
                              {"source", source}});
    } else {
      add_plain(name, "shaders/technique/" + file, source);
    }
  }
  add_plain(kReferenceTechnique, nullptr, "rays from each pixel, direct light only: drawn by render alone");
  return listing;
}

// What each basis costs: docs/experiments.md says how it is counted.
Listing list_bases(const Output& output) {
  Listing listing;
  listing.table.column("basis");
  for (const char* heading : {"coefficients", "floats", "read", "operations", "+ -", "*", "/", "sqrt", "select"})
    listing.table.column(heading, Table::Align::right);
  listing.table.column("domain");
  listing.table.column("linear");
  listing.table.column("source");
  for (const TechniqueInfo& basis : techniques()) {
    if (!basis.is_basis) continue;
    const std::string name(basis.name), source(basis.source), domain = domain_name(basis.domain);
    output.progress("counting " + name);
    const BasisCost cost = basis_cost(basis);
    const OperationCount& operations = cost.operations;
    const auto text = [](std::int64_t number) { return std::to_string(number); };
    listing.table.row({name, text(cost.coefficients), text(3 * cost.coefficients), text(cost.reads),
                       (operations.loops ? ">= " : "") + text(operations.total()), text(operations.additions),
                       text(operations.multiplications), text(operations.divisions), text(operations.square_roots),
                       text(operations.selections), domain, basis.linear ? "yes" : "no", source});
    listing.json.push_back({{"name", name},
                            {"basis", true},
                            {"coefficients", cost.coefficients},
                            {"floats", 3 * cost.coefficients},
                            {"coefficients_read", cost.reads},
                            {"operations", operations.total()},
                            {"operation_counts",
                             {{"add", operations.additions},
                              {"multiply", operations.multiplications},
                              {"divide", operations.divisions},
                              {"sqrt", operations.square_roots},
                              {"select", operations.selections},
                              {"other", operations.others},
                              {"integer", operations.integers},
                              {"loops_counted_once", operations.loops}}},
                            {"domain", domain},
                            {"linear", basis.linear},
                            {"file", "shaders/basis/" + std::string(basis.file)},
                            {"source", source}});
  }
  return listing;
}

Listing list_scenes() {
  Listing listing;
  listing.table.column("scene");
  listing.table.column("triangles", Table::Align::right);
  listing.table.column("vertices", Table::Align::right);
  listing.table.column("light");
  for (const std::string& name : scene_names()) {
    const Scene scene = load_scene(name);
    const std::string light = scene.procedural_coefficients ? "procedural"
                              : scene.lightmap_uvs.empty()  ? "baked per vertex"
                                                            : "baked to lightmaps";
    const std::size_t vertices = std::max(scene.positions.size(), scene.clip_positions.size());
    listing.table.row({name, std::to_string(scene.triangle_count()), std::to_string(vertices), light});
    listing.json.push_back(
        {{"name", name}, {"triangles", scene.triangle_count()}, {"vertices", vertices}, {"light", light}});
  }
  return listing;
}

Listing list_environments() {
  Listing listing;
  listing.table.column("environment");
  listing.table.column("size");
  for (const std::string& name : environment_names()) {
    const Environment environment = load_environment(name);
    listing.table.row({name, fmt::format("{}x{}", environment.width, environment.height)});
    listing.json.push_back({{"name", name}, {"width", environment.width}, {"height", environment.height}});
  }
  return listing;
}

// The smallest frame there is to draw: one triangle over 4 x 4 pixels, in one colour.
Frame draw_probe(const std::string& backend) {
  Bundle bundle;
  bundle.width = bundle.height = 4;
  bundle.clip_positions = {-1, -1, 0, 1, 3, -1, 0, 1, -1, 3, 0, 1};
  bundle.indices = {0, 1, 2};
  const ShaderSource shader =
      resolve_shader("probe", "out vec4 color;\nvoid main() { color = vec4(1.0); }\n", "probe.frag");
  Frame cpu_frame;
  cpu_frame.width = cpu_frame.height = 4;
  cpu_frame.color.assign(4 * 4 * 4, 1.0f);
  cpu_frame.depth.assign(4 * 4, 0.5f);
  cpu_frame.primitive_id.assign(4 * 4, 0);
  cpu_frame.coverage.assign(4 * 4, 1);
  DrawOptions options;
  options.time_limit_seconds = 20;
  Frame frame = Machines({}, true).draw(backend, bundle, shader, options, &cpu_frame);
  if (frame.color.size() != 4 * 4 * 4 || frame.color[0] != 1.0f)
    throw BackendError(backend + ": draws, but a white triangle does not come out white");
  return frame;
}

// What a driver calls itself; the JSON has the rest.
std::string driver_text(const Frame& frame) {
  std::string text;
  for (const auto& [key, value] : frame.provenance)
    if (key == "GL_RENDERER" || key == "GL_VERSION") text += (text.empty() ? "" : ", ") + value;
  return text;
}

Listing list_backends(const Output& output) {
  Listing listing;
  listing.table.column("backend");
  listing.table.column("works");
  listing.table.column("what it is, or why not");
  for (const std::string& name : backend_names()) {
    output.progress("trying " + name);
    if (name == "cpu") {  // always there; a user's shader, unlike the built-in ones, would need a compiler
      const std::string isa = isa_name(machine_isa());
      const std::string number = number_name(natural_number(machine_isa()));
      listing.table.row({name, "yes", fmt::format("{}, {}, {} threads", isa, number, thread_count())});
      listing.json.push_back({{"name", name}, {"works", true}, {"provenance", {{"isa", isa}, {"number", number}}}});
      continue;
    }
    try {
      const Frame frame = draw_probe(name);
      listing.table.row({name, "yes", driver_text(frame)});
      Json provenance = Json::object();
      for (const auto& [key, value] : frame.provenance) provenance[key] = value;
      listing.json.push_back({{"name", name}, {"works", true}, {"provenance", provenance}});
    } catch (const BackendError& error) {
      listing.table.row({name, "no", error.what()});
      listing.json.push_back({{"name", name}, {"works", false}, {"reason", error.what()}});
    }
  }
  return listing;
}

struct ListVerb {
  CommonOptions common;
  std::vector<std::string> kinds;

  int run() const {
    static const std::vector<std::string> all{"techniques", "bases", "maps", "scenes", "environments", "backends"};
    apply(common);
    const Output output(common);
    for (const std::string& kind : kinds)
      if (std::find(all.begin(), all.end(), kind) == all.end())
        throw UserError(unknown_name_message("list", kind, all));
    Json json{{"provenance", Provenance(common).json()}};
    bool first = true;
    for (const std::string& kind : all) {
      const bool wanted = kinds.empty() || std::find(kinds.begin(), kinds.end(), kind) != kinds.end();
      if (!wanted) continue;
      const Listing listing = kind == "techniques"     ? list_techniques()
                              : kind == "bases"        ? list_bases(output)
                              : kind == "maps"         ? list_maps()
                              : kind == "scenes"       ? list_scenes()
                              : kind == "environments" ? list_environments()
                                                       : list_backends(output);
      output.text((first ? "" : "\n") + listing.table.text());
      json[kind] = listing.json;
      first = false;
    }
    output.json(json);
    return 0;
  }
};

}  // namespace

Verb add_list(CLI::App& app) {
  CLI::App* command = app.add_subcommand("list", "what there is to draw, to draw with and to draw on");
  const auto verb = std::make_shared<ListVerb>();
  command->add_option("kind", verb->kinds, "techniques, bases, maps, scenes, environments, backends (default: all)")
      ->delimiter(',')
      ->type_name("KIND");
  add_common_options(*command, verb->common);
  return {command, [verb] { return verb->run(); }};
}

}  // namespace twinshade
