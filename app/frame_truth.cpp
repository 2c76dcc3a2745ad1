#include "app/frame_truth.h"

#include <fmt/format.h>
#include <CLI/CLI.hpp>

#include <cmath>
#include <filesystem>

#include "app/machines.h"
#include "base/error.h"
#include "scenes/model_file.h"

namespace twinshade {

void add_truth_options(CLI::App& command, TruthOptions& options) {
  add_whole_option(command, "--pixels", "pixels whose light is traced (default: 16384)", 1, 1u << 24,
                   [&](std::uint64_t value) { options.pixels = value; });
  add_whole_option(command, "--reference-rays", "rays that light is traced by, for each of them (default: 512)", 2,
                   65536, [&](std::uint64_t value) { options.rays = value; });
}

void require_traceable(const std::string& scene, const std::string& verb) {
  std::error_code code;
  if (std::filesystem::is_regular_file(scene, code) && model_file_ending(scene).empty())
    throw UserError(fmt::format(
        "{}: {} traces rays through a scene, which a bundle has not: name a built-in scene or a model (.gltf, .glb or "
        ".obj)",
        scene, verb));
}

VisiblePoints visible_points(const LitScene& lit, const SubjectOptions& subject, const CpuOptions& cpu,
                             const Output& output) {
  Machines machines(cpu, true);
  output.progress("drawing what is visible");
  VisiblePoints visible =
      draw_visible_points(lit.scene, frame_options(subject, lit.scene),
                          [&](const std::string& machine, const Bundle& bundle, const ShaderSource& source) {
                            return machines.draw(machine, bundle, source, DrawOptions());
                          });
  if (visible.points.empty())
    throw UserError(subject.scene +
                    ": the camera sees no surface, so there is no light to compare; give another --camera");
  return visible;
}

Truths trace_truths(const LitScene& lit, const VisiblePoints& visible, const SubjectOptions& subject,
                    const TruthOptions& options, const CommonOptions& common) {
  Truths truths;
  std::vector<ShadedPoint> points;
  for (const std::size_t place : stratified_places(visible.points.size(), options.pixels, common.seed)) {
    points.push_back(visible.points[place]);
    truths.direct.pixels.push_back(visible.pixels[place]);
  }
  truths.bounced.pixels = truths.direct.pixels;
  BakeOptions surfaces;
  surfaces.lightmap_size = subject.lightmap_size;
  surfaces.rays = subject.rays;
  surfaces.seed = common.seed;
  ReferenceOptions reference;
  reference.rays = std::uint32_t(options.rays);
  reference.seed = common.seed;
  reference.show_progress = !common.quiet;
  const auto halves = reference_light(lit.scene, lit.environment, points, surfaces, reference);
  for (std::size_t half = 0; half < 2; ++half)
    for (const ReflectedLight& light : halves[half]) {
      truths.direct.radiance[half].push_back(light.direct);
      truths.bounced.radiance[half].push_back(light.direct + light.bounced);
    }
  truths.noise = truth_noise(truths.bounced);
  return truths;
}

std::string noise_percent(const Truths& truths) {
  const double percent = 100 * truths.noise;
  return percent < 99.5 ? fmt::format("{:.2g}", percent) : fmt::format("{:.0f}", percent);  // not 1e+02
}

std::string truth_line(const SubjectOptions& subject, const TruthOptions& options, const Truths& truths) {
  return fmt::format("{} under {}, {} x {}; light traced for {} pixels by {} rays, ", subject.scene,
                     subject.environment, subject.width, subject.height, truths.direct.pixels.size(), options.rays) +
         (std::isfinite(truths.noise) ? fmt::format("its own noise {} %", noise_percent(truths))
                                      : "which found none: nothing has an error");
}

Json truth_json(const TruthOptions& options, const Truths& truths) {
  return {{"pixels", truths.direct.pixels.size()},
          {"rays", options.rays},
          {"noise", std::isfinite(truths.noise) ? Json(truths.noise) : Json(nullptr)}};
}

}  // namespace twinshade
