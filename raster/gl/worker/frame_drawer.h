// Draws what a request asks for and leaves the pixels in shared memory.
#pragma once

#include <memory>

#include "raster/gl/worker/draw_data.h"
#include "raster/gl/worker/render_targets.h"

namespace twinshade::gl {

class FrameDrawer {
 public:
  explicit FrameDrawer(const GlFunctions& gl) : gl_(gl), programs_(gl), data_(gl) {}
  DrawData& data() { return data_; }
  // `frame` is laid out by frame_layout, or row_layout for Geometry::rows. The reply's outcome is ok; everything else
  // is thrown.
  DrawReply draw(const DrawRequest& request, const SharedMemory& frame);
  // Runs a compute shader; `storage` is laid out by storage_bytes.
  DrawReply dispatch(const DrawRequest& request, const SharedMemory& storage);

 private:
  enum class Depth { less, equal };
  void submit(const DrawRequest& request, const Program& program, Depth depth);
  double timed_milliseconds(const DrawRequest& request);
  void make_targets(const DrawRequest& request);
  DrawReply draw_rows(const DrawRequest& request, const SharedMemory& rows);
  void capture(const DrawRequest& request, std::uint32_t components, std::byte* planes);

  const GlFunctions& gl_;
  ProgramCache programs_;
  DrawData data_;
  std::unique_ptr<RenderTargets> targets_;
};

}  // namespace twinshade::gl
