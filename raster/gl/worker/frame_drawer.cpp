#include "raster/gl/worker/frame_drawer.h"

#include <algorithm>
#include <bit>
#include <chrono>
#include <vector>

namespace twinshade::gl {
namespace {

using Clock = std::chrono::steady_clock;

double milliseconds_since(Clock::time_point start) {
  return std::chrono::duration<double, std::milli>(Clock::now() - start).count();
}

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

}  // namespace

void FrameDrawer::submit(const DrawRequest& request, const Program& program, Depth depth) {
  data_.bind(program, request);
  const auto viewport = [](std::uint32_t size) { return GLsizei(std::bit_ceil(size)); };
  gl_.Viewport(0, 0, viewport(request.width), viewport(request.height));
  if (request.geometry == Geometry::full_screen || request.geometry == Geometry::rows) {
    gl_.Disable(GL_DEPTH_TEST);
    gl_.DrawArrays(GL_TRIANGLES, 0, 3);
    return;
  }
  gl_.Enable(GL_DEPTH_TEST);
  gl_.DepthFunc(depth == Depth::less ? GL_LESS : GL_EQUAL);
  gl_.DepthMask(depth == Depth::less ? GL_TRUE : GL_FALSE);
  (request.cull_back_faces ? gl_.Enable : gl_.Disable)(GL_CULL_FACE);
  gl_.CullFace(GL_BACK);
  gl_.DrawElements(GL_TRIANGLES, GLsizei(data_.index_count()), GL_UNSIGNED_INT, nullptr);
  gl_.DepthMask(GL_TRUE);
}

// A frame as a program draws it: clears, drawing, and waiting until all is done.
double FrameDrawer::timed_milliseconds(const DrawRequest& request) {
  const Program& program = programs_.get(request.timed, request.initialized);
  const Program* prepass = request.prepass_wanted ? &programs_.get(request.prepass, request.initialized) : nullptr;
  std::vector<double> samples;
  for (int i = 0; i < request.warmup + request.repeat; ++i) {
    data_.restore_storage();
    gl_.Finish();
    const auto start = Clock::now();
    targets_->begin_color();
    if (prepass != nullptr) {
      gl_.ColorMask(GL_FALSE, GL_FALSE, GL_FALSE, GL_FALSE);
      submit(request, *prepass, Depth::less);
      gl_.ColorMask(GL_TRUE, GL_TRUE, GL_TRUE, GL_TRUE);
    }
    submit(request, program, prepass != nullptr ? Depth::equal : Depth::less);
    gl_.Finish();
    if (i >= request.warmup) samples.push_back(milliseconds_since(start));
  }
  return median(samples);
}

void FrameDrawer::capture(const DrawRequest& request, std::uint32_t components, std::byte* planes) {
  const std::size_t pixels = std::size_t(request.width) * request.height;
  std::vector<std::uint32_t> texels(pixels * 4);
  auto* const plane = reinterpret_cast<std::uint32_t*>(planes);
  std::uint32_t component = 0;
  for (const ProgramText& text : request.captures) {
    const std::uint32_t targets = std::min(kCaptureTargets, (components - component + 3) / 4);
    data_.restore_storage();
    const Program& program = programs_.get(text, request.initialized);
    targets_->begin_capture(targets);
    submit(request, program, Depth::less);
    gl_.Finish();
    check_errors(gl_, "capturing values");
    for (std::uint32_t target = 0; target < targets; ++target) {
      targets_->read_capture(target, texels.data());
      for (std::uint32_t c = 0; c < 4 && component < components; ++c, ++component)
        for (std::size_t p = 0; p < pixels; ++p) plane[component * pixels + p] = texels[p * 4 + c];
    }
  }
}

void FrameDrawer::make_targets(const DrawRequest& request) {
  if (targets_ && targets_->fits(request.width, request.height)) return;
  targets_.reset();
  targets_ = std::make_unique<RenderTargets>(gl_, request.width, request.height);
}

DrawReply FrameDrawer::draw_rows(const DrawRequest& request, const SharedMemory& rows) {
  const std::size_t pixels = std::size_t(request.width) * request.height;
  const FrameLayout layout = row_layout(pixels, request.components, request.results);
  if (rows.size() < layout.size) throw std::runtime_error("the shared rows are too small");
  make_targets(request);
  data_.set_cpu_pixels(request.width, request.height, request.components, nullptr, rows.data() + layout.cpu_attributes);
  data_.bind_geometry(request);
  capture(request, request.results, rows.data() + layout.attributes);
  check_errors(gl_, "reading results back");
  return {};
}

DrawReply FrameDrawer::draw(const DrawRequest& request, const SharedMemory& frame) {
  if (request.geometry == Geometry::rows) return draw_rows(request, frame);
  const bool full_screen = request.geometry == Geometry::full_screen;
  const std::size_t pixels = std::size_t(request.width) * request.height;
  const FrameLayout layout = frame_layout(pixels, request.components, full_screen);
  if (frame.size() < layout.size) throw std::runtime_error("the shared frame is too small");
  make_targets(request);
  if (full_screen)
    data_.set_cpu_pixels(request.width, request.height, request.components, frame.data() + layout.cpu_id,
                         frame.data() + layout.cpu_attributes);
  data_.bind_geometry(request);

  DrawReply reply;
  const Program& program = programs_.get(request.frame, request.initialized);
  if (request.timing) reply.milliseconds = {{"draw", timed_milliseconds(request)}};

  data_.restore_storage();
  gl_.Finish();
  const auto start = Clock::now();
  targets_->begin_frame();
  submit(request, program, Depth::less);
  gl_.Finish();
  if (!request.timing) reply.milliseconds = {{"draw", milliseconds_since(start)}};
  check_errors(gl_, "drawing");
  targets_->read_color(frame.data() + layout.color);
  targets_->read_id(frame.data() + layout.id);
  if (!full_screen) targets_->read_depth(frame.data() + layout.depth);
  check_errors(gl_, "reading the frame back");

  if (!request.captures.empty()) capture(request, request.components, frame.data() + layout.attributes);
  check_errors(gl_, "reading attributes back");
  return reply;
}

DrawReply FrameDrawer::dispatch(const DrawRequest& request, const SharedMemory& storage) {
  if (storage.size() < storage_bytes(data_.index())) throw std::runtime_error("the shared memory is too small");
  data_.restore_storage();
  data_.bind(programs_.get(request.frame, request.initialized), request);
  const auto start = Clock::now();
  gl_.DispatchCompute(request.groups[0], request.groups[1], request.groups[2]);
  gl_.MemoryBarrier(GL_ALL_BARRIER_BITS);
  gl_.Finish();
  DrawReply reply;
  reply.milliseconds = {{"dispatch", milliseconds_since(start)}};
  check_errors(gl_, "running the compute shader");
  data_.read_storage(storage.data());
  return reply;
}

}  // namespace twinshade::gl
