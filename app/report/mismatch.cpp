#include "app/report/mismatch.h"

#include <fmt/format.h>

#include <bit>
#include <cmath>

namespace twinshade {
namespace {

bool is_discrete(const Difference& d) { return d.layer == "coverage" || d.layer == "id"; }

std::string component_name(const Difference& d, const Frame& frame_a) {
  if (d.layer == "color") return fmt::format("color.{}", "rgba"[d.component]);
  if (d.layer == "attributes" && d.component < frame_a.attribute_names.size())
    return frame_a.attribute_names[d.component];
  return d.layer;
}

std::string id_text(std::uint32_t id) { return id == kNoPrimitive ? "none" : std::to_string(id); }

// Floats in hexadecimal, integers' bits.
std::string hex_text(Scalar scalar, std::uint32_t bits) {
  return scalar == Scalar::f32 ? hex_float(std::bit_cast<float>(bits)) : fmt::format("0x{:08x}", bits);
}

std::string number_text(Scalar scalar, std::uint32_t bits) {
  return scalar == Scalar::f32 ? fmt::format("{} ({})", std::bit_cast<float>(bits), hex_text(scalar, bits))
                               : fmt::format("{:.0f} ({})", value_of(scalar, bits), hex_text(scalar, bits));
}

std::string value_text(const Difference& d, std::uint32_t bits) {
  if (d.layer == "coverage") return bits ? "covered" : "not covered";
  if (d.layer == "id") return "triangle " + id_text(bits);
  return number_text(d.scalar, bits);
}

std::string distance_text(const Difference& d) {
  if (d.scalar != Scalar::f32) return fmt::format("{} apart", d.ulp);
  return d.ulp == UINT64_MAX ? "NaN on one side" : fmt::format("{} ULP", d.ulp);
}

std::string values_text(const Difference& d, const std::string& a, const std::string& b, const Frame& frame_a) {
  std::string text = fmt::format("{}: {} {}, {} {}", component_name(d, frame_a), a, value_text(d, d.a_bits), b,
                                 value_text(d, d.b_bits));
  if (!is_discrete(d)) text += ": " + distance_text(d);
  return text;
}

std::string histogram_text(const Comparison& comparison) {
  std::string text;
  for (std::size_t bin = 1; bin < comparison.ulp_histogram.size(); ++bin) {
    const std::uint64_t count = comparison.ulp_histogram[bin];
    if (count == 0) continue;
    if (!text.empty()) text += ", ";
    if (bin == 64)
      text += fmt::format("NaN on one side: {}", count);
    else if (bin == 1)
      text += fmt::format("1: {}", count);
    else
      text += fmt::format("{}-{}: {}", 1ull << (bin - 1), (1ull << bin) - 1, count);
  }
  return text;
}

Json float_json(double value) { return std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value)); }

}  // namespace

std::string describe_mismatch(const std::string& technique, const std::string& a, const std::string& b,
                              const Comparison& comparison, const Frame& frame_a) {
  if (!comparison.first) return "";
  const Difference& first = *comparison.first;
  const auto triangle = frame_a.primitive_id[std::size_t(first.y) * frame_a.width + first.x];
  std::string text = fmt::format(
      "\n{}: {} and {} differ, first in layer {}, at pixel ({}, {}) (y up; row {} from the top), triangle {}\n",
      technique, a, b, first.layer, first.x, first.y, frame_a.height - 1 - first.y, id_text(triangle));
  text += "  " + values_text(first, a, b, frame_a) + '\n';
  if (!first.inputs.empty()) {
    text += "  inputs of the shader there:\n";
    for (const auto& [name, scalar, bits] : first.inputs)
      text += fmt::format("    {} = {}\n", name, number_text(scalar, bits));
  }
  if (comparison.worst.size() > 1) {
    text += fmt::format("  worst of layer {}:\n", first.layer);
    for (const Difference& d : comparison.worst)
      text += fmt::format("    ({}, {}) {}\n", d.x, d.y, values_text(d, a, b, frame_a));
  }
  if (const std::string histogram = histogram_text(comparison); !histogram.empty())
    text += fmt::format("  colour components by {}: {}\n", frame_a.color_scalar == Scalar::f32 ? "ULP" : "distance",
                        histogram);
  return text;
}

CaseResult::Pictures mismatch_pictures(const std::string& a, const Frame& frame_a, const std::string& b,
                                       const Frame& frame_b, const std::optional<Difference>& first,
                                       const PictureOptions& options) {
  CaseResult::Pictures pictures{frame_a.width, frame_a.height};
  if (first) pictures.x = first->x, pictures.y = frame_a.height - 1 - first->y;
  pictures.list = {
      {a, picture_png(frame_a, options)},
      {b, picture_png(frame_b, options)},
      {"difference: blue 1 ULP, through green and yellow to red 2^16 or more; white NaN, cyan depth, orange "
       "triangle, magenta coverage",
       difference_png(frame_a, frame_b)}};
  return pictures;
}

Json difference_json(const std::optional<Difference>& difference, const Frame& frame_a) {
  if (!difference) return nullptr;
  const Difference& d = *difference;
  Json json;
  json["layer"] = d.layer;
  json["x"] = d.x;
  json["y"] = d.y;
  json["component"] = component_name(d, frame_a);
  json["a"] = float_json(d.a);
  json["b"] = float_json(d.b);
  if (!is_discrete(d)) {
    json["a_hex"] = hex_text(d.scalar, d.a_bits);
    json["b_hex"] = hex_text(d.scalar, d.b_bits);
    json["ulp"] = ulp_json(d.ulp);
  }
  json["inputs"] = Json::array();
  for (const auto& [name, scalar, bits] : d.inputs)
    json["inputs"].push_back(
        {{"name", name}, {"value", float_json(value_of(scalar, bits))}, {"hex", hex_text(scalar, bits)}});
  return json;
}

void add_comparison(Json& json, const Comparison& c, const Json& first_difference) {
  json["shaded_pixels"] = c.shaded_pixels;
  json["coverage_differs"] = c.coverage_differs;
  json["id_differs"] = c.id_differs;
  json["depth_differs"] = c.depth_differs;
  json["attributes_differ"] = c.attributes_differ;
  json["pixels_differ"] = c.pixels_differ;
  json["denormal_only"] = c.denormal_only;
  json["max_ulp"] = ulp_json(c.max_ulp);
  json["first_difference"] = first_difference;
}

}  // namespace twinshade
