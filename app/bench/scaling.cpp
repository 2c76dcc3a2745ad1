#include "app/bench/scaling.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <map>
#include <numeric>

#include "app/bench/overdraw.h"
#include "app/memory_needed.h"
#include "app/subject.h"
#include "base/error.h"
#include "base/names.h"
#include "base/parallel.h"
#include "cpu_shaders/machine.h"
#include "experiments/chart.h"
#include "lighting/driver_source.h"

namespace twinshade::bench {
namespace {

struct Size {
  std::uint32_t width, height;
};
constexpr Size kSizes[] = {{64, 64},    {160, 100},   {320, 200},   {640, 400},   {854, 480},  {1280, 800},
                           {1366, 768}, {1920, 1080}, {2560, 1600}, {3840, 2160}, {7680, 4320}};
// Frames whose rows begin in the middle of a cache line are stored another way.
static_assert(std::any_of(std::begin(kSizes), std::end(kSizes), [](const Size& size) { return size.width % 4 != 0; }));
constexpr std::uint32_t kTriangles[] = {100, 1000, 10000, 100000, 1000000, 5000000};
constexpr int kLayers[] = {1, 2, 4, 8, 16, 32};
// From lightmaps, then from volumes: 1 to 36 coefficients a channel.
const std::vector<std::string> kLightmapTechniques{"lightmap", "hl2", "h4", "h6", "sh3", "sh5"};
const std::vector<std::string> kVolumeTechniques{"sh2", "sh3", "sh4", "sh5", "sh6"};

// A square that fills a square frame to its edges, whatever it is divided into.
constexpr std::uint32_t kSquareFrame = 1024;
Camera square_camera() {
  Camera camera;
  const glm::dvec3 centre(0, 0.8, -0.6), normal(0, 0.6, 0.8);
  camera.eye = centre + normal * 2.0;
  camera.target = centre;
  camera.vertical_fov_degrees = 53.13;  // 2 atan(1 / 2)
  return camera;
}

struct Axis {
  std::string name, title;
};
const std::vector<Axis>& axes() {
  static const std::vector<Axis> list{{"pixels", "pixels that are shaded"},
                                      {"triangles", "triangles"},
                                      {"overdraw", "layers over each other, the farthest first"},
                                      {"threads", "threads"},
                                      {"coefficients", "RGB coefficients that the shader reads"}};
  return list;
}

class ScalingRun {
 public:
  ScalingRun(const ScalingOptions& options, const CommonOptions& common, const Output& output)
      : options_(options), common_(common), output_(output), technique_(find_technique(options.technique)) {
    if (!technique_.is_basis || !can_read(technique_, CoefficientStorage::lightmap))
      throw UserError(
          fmt::format("--technique {}: scaling draws with a basis that is read from lightmaps", options.technique));
    require_axes(options.axes);
  }

  ScalingResult run() {
    if (asked("pixels")) pixels();
    if (asked("triangles")) triangles();
    if (asked("overdraw")) overdraw();
    if (asked("threads")) threads();
    if (asked("coefficients")) coefficients();
    ScalingResult result{{rows_, notes_, {}}, failed_};
    for (const Axis& axis : axes())
      if (asked(axis.name)) add_pictures(axis, result);
    return result;
  }

 private:
  bool asked(const std::string& axis) const { return has_axis(options_.axes, axis); }

  // Baked once: what light a surface gets does not depend on how finely it is divided.
  LightBake bake(const Scene& scene) const {
    require_lightmap_memory(options_.subject, {{&technique_, CoefficientStorage::lightmap}});
    BakeOptions bake;
    bake.lightmap_size = options_.subject.lightmap_size;
    bake.rays = options_.subject.rays;
    bake.seed = common_.seed;
    bake.show_progress = !common_.quiet;
    return bake_light(scene, load_light(options_.subject), bake);
  }

  Bundle square(const LightBake& light, std::uint32_t triangles) const {
    FrameOptions frame;
    frame.width = frame.height = kSquareFrame;
    frame.camera = square_camera();
    return make_bundle(load_scene("quad", triangles), light, {&technique_}, frame);
  }

  // Whether `check`, one of memory, passes; if not, why is noted.
  template <class Check>
  bool fits(const std::string& axis, const Check& check) {
    try {
      check();
      return true;
    } catch (const UserError& error) {
      notes_.push_back(axis + " ends here: " + error.what());
      return false;
    }
  }

  // The scene that --scaling was given.
  Scene load() const {
    require_scene_memory(options_.subject);
    Scene scene = load_scene(options_.subject.scene, options_.subject.triangles, !options_.subject.camera);
    output_.require_not_read(scene.files);
    note_scene(output_, options_.subject, scene);
    if (scene.lightmap_uvs.empty())
      throw UserError(options_.subject.scene + " has no lightmap coordinates, and --scaling draws from lightmaps");
    return scene;
  }

  void pixels() {
    const Scene scene = load();
    const LightBake light = bake(scene);
    for (const Size& size : kSizes) {
      SubjectOptions subject = options_.subject;
      subject.width = size.width, subject.height = size.height;
      if (!fits("pixels", [&] { require_frame_memory(size.width, size.height, "egl"); })) return;
      measure("pixels", 0, make_bundle(scene, light, {&technique_}, frame_options(subject, scene)));
    }
  }

  void triangles() {
    const LightBake light = bake(load_scene("quad"));
    for (const std::uint32_t count : kTriangles) {
      SubjectOptions subject = options_.subject;
      subject.scene = "quad";
      subject.triangles = count;
      if (!fits("triangles", [&] { require_scene_memory(subject); })) return;
      const Bundle bundle = square(light, count);
      measure("triangles", double(bundle.triangle_count()), bundle);
    }
  }

  void overdraw() {
    const Bundle one = square(bake(load_scene("quad")), 10000);
    for (const int layers : kLayers) measure("overdraw", layers, with_overdraw(one, layers));
  }

  void threads() {
    const int most = thread_count();
    const Scene scene = load();
    const Bundle bundle = make_bundle(scene, bake(scene), {&technique_}, frame_options(options_.subject, scene));
    for (int count = 1;; count = std::min(2 * count, most)) {
      set_thread_count(count);
      measure("threads", count, bundle);
      if (count == most) return;
    }
  }

  void coefficients() {
    for (const bool volume : {false, true}) {
      ShadingOptions shading;
      shading.techniques = volume ? kVolumeTechniques : kLightmapTechniques;
      shading.light = volume ? LightSource::volume : LightSource::lightmap;
      const Subject subject = load_subject(options_.subject, shading, common_, output_);
      std::vector<Shading> shaders = load_shadings(shading, subject);
      std::sort(shaders.begin(), shaders.end(), [](const Shading& a, const Shading& b) {  // lines run to the right
        return find_technique(a.technique).count < find_technique(b.technique).count;
      });
      for (const Shading& shader : shaders) {
        const TechniqueInfo& technique = find_technique(shader.technique);
        const auto storage = volume ? CoefficientStorage::volume : CoefficientStorage::lightmap;
        measure("coefficients", technique.count, subject.bundle, technique, storage);
      }
    }
  }

  void measure(const std::string& axis, double value, const Bundle& bundle) {
    measure(axis, value, bundle, technique_, CoefficientStorage::lightmap);
  }

  // value 0: the pixels that were shaded.
  void measure(const std::string& axis, double value, const Bundle& bundle, const TechniqueInfo& technique,
               CoefficientStorage storage) {
    CpuOptions cpu = options_.cpu;
    if (!cpu.isa) cpu.isa = machine_isa();
    const ShaderSource source = technique_source(technique, storage);
    const std::vector<Way> ways =
        distinct_ways(all_ways(cpu, {AttributeMode::exact}, options_.host_fma), source, options_.cpu.isa);
    const std::string point =
        fmt::format("{}: {}", axis, value > 0 ? value : double(bundle.width) * double(bundle.height));
    output_.progress(point);
    const std::vector<Timing> timings =
        race(ways, bundle, source, driver_source(technique, storage, sphere_maps().front()), options_.rounds);
    const Timing* llvmpipe = faster_llvmpipe(timings);
    for (const Timing& timing : timings)
      if (!timing.failure.empty()) {
        notes_.push_back(fmt::format("{}: {}: {}", point, timing.way.name(), timing.failure));
        failed_ = true;
      }
    for (const Timing& timing : timings) {
      if (!timing.drawn() || (!timing.way.is_cpu() && &timing != llvmpipe)) continue;
      const Quartiles ms = quartiles(timing.milliseconds);
      std::vector<Cell> cells{Cell(axis),
                              Cell(value > 0 ? value : double(timing.shaded_pixels)),
                              Cell(std::string(technique.name)),
                              Cell(std::string(storage_name(storage))),
                              Cell(std::int64_t(bundle.width)),
                              Cell(std::int64_t(bundle.height)),
                              Cell(std::int64_t(timing.shaded_pixels)),
                              Cell(std::int64_t(bundle.triangle_count())),
                              Cell(std::int64_t(thread_count())),
                              Cell(timing.way.name()),
                              timing.way.is_cpu() ? Cell(std::string(isa_name(*timing.way.cpu.isa))) : Cell(),
                              Cell(ms.median),
                              Cell(ms.q1),
                              Cell(ms.q3),
                              number_cell(timing.ns_per_pixel())};
      for (std::size_t s = 0; s < kStageCount; ++s)
        cells.push_back(timing.stages[s].empty() ? Cell() : Cell(timing.stage(s)));
      cells.push_back(timing.way.is_cpu() ? Cell(std::int64_t(timing.peak_memory)) : Cell());
      rows_.add(std::move(cells));
    }
    if (rows_.size() > 0) options_.measured(rows_, notes_);
  }

  // Of one axis, `column` against its values, which rise: a line for each machine, and where light is read from on the
  // axis of coefficients. A frame with more pixels than the one before may show less of the scene.
  std::vector<Series> series(const std::string& axis, const std::string& column, double scale,
                             const std::string& prefix = "") const {
    std::vector<std::size_t> rising(rows_.size());
    std::iota(rising.begin(), rising.end(), std::size_t{0});
    std::stable_sort(rising.begin(), rising.end(),
                     [&](std::size_t a, std::size_t b) { return rows_.number(a, "value") < rows_.number(b, "value"); });
    std::map<std::string, Series> by_label;
    for (const std::size_t r : rising) {
      if (std::get<std::string>(rows_.at(r, "axis")) != axis) continue;
      const double y = rows_.number(r, column) * scale;
      if (!(y > 0)) continue;
      const bool cpu = std::get<std::string>(rows_.at(r, "renderer")) == "cpu";
      std::string label = !prefix.empty() ? prefix : cpu ? "cpu" : "llvmpipe";
      if (axis == "coefficients") label += " (" + std::get<std::string>(rows_.at(r, "light")) + ")";
      Series& one = by_label[label];
      one.label = label;
      one.markers = true;
      one.x.push_back(rows_.number(r, "value"));
      one.y.push_back(y);
    }
    std::vector<Series> list;
    for (auto& [label, one] : by_label) list.push_back(std::move(one));
    return list;
  }

  // The instruction set that ran: of one number type it is the same everywhere.
  std::string isa_drawn() const {
    for (std::size_t r = 0; r < rows_.size(); ++r)
      if (const auto* isa = std::get_if<std::string>(&rows_.at(r, "isa"))) return *isa;
    return "cpu";
  }

  void add_pictures(const Axis& axis, ExperimentResult& result) const {
    const bool per_pixel = axis.name == "pixels";
    LineChart cost;
    cost.title = "Cost against " + axis.name;
    const bool with_stages = !per_pixel && axis.name != "coefficients";
    cost.subtitle = fmt::format("medians; {}, exact attributes, against llvmpipe's better way{}", isa_drawn(),
                                with_stages ? "; and the CPU's stages" : "");
    const bool logarithmic = axis.name != "coefficients" && axis.name != "threads";
    cost.x = {axis.title, logarithmic, {}, {}, axis.name == "threads"};
    cost.y = {per_pixel ? "nanoseconds a pixel" : "milliseconds", true};
    cost.series = series(axis.name, per_pixel ? "ns_per_pixel" : "ms", 1);
    if (with_stages)
      for (const char* stage : kStageNames)
        for (Series& one : series(axis.name, std::string(stage) + "_ms", 1, stage))
          cost.series.push_back(std::move(one));
    if (!cost.series.empty()) result.pictures.push_back({"scaling-" + axis.name, twinshade::draw(cost)});

    if (axis.name == "coefficients") return;  // one bundle holds those of all techniques: no line would rise
    LineChart memory;
    memory.title = "Memory against " + axis.name;
    memory.subtitle = "the most that the process held in RAM while the CPU drew, bundle included";
    memory.x = cost.x;
    memory.y = {"MiB", true};
    memory.series = series(axis.name, "peak_memory", 1.0 / (1 << 20));
    if (!memory.series.empty())
      result.pictures.push_back({"scaling-" + axis.name + "-memory", twinshade::draw(memory)});
  }

  const ScalingOptions& options_;
  const CommonOptions& common_;
  const Output& output_;
  const TechniqueInfo& technique_;
  std::vector<std::string> notes_;
  bool failed_ = false;
  Rows rows_{{"axis",           "value",     "technique",    "light",      "width",  "height",
              "shaded_pixels",  "triangles", "threads",      "renderer",   "isa",    "ms",
              "ms_q1",          "ms_q3",     "ns_per_pixel", "vertex_ms",  "bin_ms", "raster_ms",
              "interpolate_ms", "shade_ms",  "store_ms",     "peak_memory"}};
};

}  // namespace

const std::vector<std::string>& scaling_axes() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> list;
    for (const Axis& axis : axes()) list.push_back(axis.name);
    return list;
  }();
  return names;
}

void require_axes(const std::vector<std::string>& axes) {
  for (const std::string& name : axes)
    if (name != "all" && std::find(scaling_axes().begin(), scaling_axes().end(), name) == scaling_axes().end())
      throw UserError(unknown_name_message("axis", name, scaling_axes()));
}

bool has_axis(const std::vector<std::string>& axes, const std::string& axis) {
  return std::any_of(axes.begin(), axes.end(), [&](const std::string& name) { return name == axis || name == "all"; });
}

std::vector<std::string> scaling_pictures(const std::vector<std::string>& axes) {
  std::vector<std::string> pictures;
  for (const std::string& axis : scaling_axes())
    if (has_axis(axes, axis))
      for (const char* of : {"", "-memory"}) pictures.push_back("scaling-" + axis + of);
  return pictures;
}

ScalingResult run_scaling(const ScalingOptions& options, const CommonOptions& common, const Output& output) {
  return ScalingRun(options, common, output).run();
}

}  // namespace twinshade::bench
