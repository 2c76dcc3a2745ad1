#include "raster/gl/gl_rows.h"

#include <algorithm>
#include <cstring>

#include "base/error.h"
#include "cpu_shaders/rewrite/make_exact.h"
#include "raster/gl/gl_session.h"

namespace twinshade {
namespace gl {
namespace {

class GlRowRenderer final : public RowRenderer {
 public:
  GlRowRenderer(GlBackend backend, GlEnvironment environment)
      : backend_(backend), session_(backend, std::move(environment)) {}

  RowResults run(const FragmentRows& table, const ShaderSource& author, double time_limit_seconds) override {
    TWINSHADE_CHECK_LE(std::size_t{1}, table.rows);
    TWINSHADE_CHECK_LE(table.rows, kMostGridRows);
    const ShaderSource source = session_.writes_out() ? make_exact(author, ExactScope::written_out).source : author;
    const FragmentShader shader = rewrite_fragment_shader(source, InputStyle::rows);
    if (backend_ == GlBackend::softpipe && !shader.derivative.empty()) {
      refused_ = true;
      throw BackendError(shader.derivative +
                         " is not evaluated on softpipe, which takes one derivative for a whole quad");
    }
    const std::vector<Input> inputs = supplied_inputs(table.inputs, source, shader.inputs);
    const ShaderGenerator generator(source, shader, inputs, quads_ ? Supply::row_quads : Supply::rows,
                                    backend_ == GlBackend::softpipe ? 330 : 450);

    Bundle grid = table.resources;  // no vertices: nothing of them need be sent
    grid.width = width(), grid.height = grid_height(table.rows);
    DrawRequest request = request_for(grid, source, generator, time_limit_seconds);
    const std::vector<std::string> names = generator.result_names();
    request.components = std::uint32_t(generator.component_names().size());
    request.results = std::uint32_t(names.size());
    for (std::uint32_t first = 0; first < request.results; first += 4 * kCaptureTargets)
      request.captures.push_back(generator.result(first));

    const std::size_t pixels = std::size_t{grid.width} * grid.height;
    const FrameLayout layout = row_layout(pixels, request.components, request.results);
    DrawReply reply = session_.exchange(grid, source, request, layout.size,
                                        [&] { put_inputs(table, generator.leaves(), pixels, layout); });
    RowResults results = results_of(names, table.rows, pixels, layout);
    results.provenance = std::move(reply.provenance);
    return results;
  }

  bool started() const override { return refused_ || session_.started(); }

 private:
  // Planes of one component each. What is left of the grid repeats the last row: it does nothing that the rows do not
  // do.
  void put_inputs(const FragmentRows& table, const std::vector<InputLeaf>& leaves, std::size_t pixels,
                  const FrameLayout& layout) {
    auto* plane = reinterpret_cast<std::uint32_t*>(session_.memory() + layout.cpu_attributes);
    for (const InputLeaf& leaf : leaves) {
      const auto attribute = std::find_if(table.inputs.begin(), table.inputs.end(),
                                          [&](const Attribute& a) { return a.name == leaf.name; });
      TWINSHADE_CHECK_EQ(attribute->values.size(), table.rows * leaf.components);
      for (std::uint32_t c = 0; c < leaf.components; ++c, plane += pixels)
        for (std::size_t place = 0; place < pixels / (quads_ ? 4 : 1); ++place) {
          const std::size_t row = std::min(place, table.rows - 1);
          std::memcpy(plane + pixel_index(place), &attribute->values[row * leaf.components + c], 4);
        }
    }
  }

  RowResults results_of(std::vector<std::string> names, std::size_t rows, std::size_t pixels,
                        const FrameLayout& layout) const {
    const auto* planes = reinterpret_cast<const std::uint32_t*>(session_.memory() + layout.attributes);
    RowResults results;
    results.kept.assign(rows, 1);
    const bool discards = !names.empty() && names.front() == kKept;
    if (discards) {
      for (std::size_t row = 0; row < rows; ++row) results.kept[row] = std::uint8_t(planes[pixel_index(row)]);
      names.erase(names.begin());
      planes += pixels;
    }
    for (std::size_t c = 0; c < names.size(); ++c, planes += pixels)
      for (std::size_t row = 0; row < rows; ++row) results.bits.push_back(planes[pixel_index(row)]);
    results.names = std::move(names);
    return results;
  }

  std::uint32_t width() const { return quads_ ? 4 * kGridWidth : kGridWidth; }

  // Of a row of quads the first pixel: see Supply::row_quads.
  std::size_t pixel_index(std::size_t row) const {
    const auto [x, y] = grid_pixel(row);
    if (!quads_) return std::size_t{y} * kGridWidth + x;
    return std::size_t{y / 2 * 2} * width() + (y % 2 * kGridWidth + x) * 2;
  }

  const GlBackend backend_;
  const bool quads_ = backend_ == GlBackend::softpipe;  // a row is a quad, not a pixel
  GlSession session_;
  bool refused_ = false;
};

}  // namespace
}  // namespace gl

std::unique_ptr<RowRenderer> make_gl_row_renderer(GlBackend backend, const GlEnvironment& environment) {
  return std::make_unique<gl::GlRowRenderer>(backend, environment);
}

}  // namespace twinshade
