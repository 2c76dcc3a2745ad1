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
  // `frame` is laid out by frame_layout. The reply's outcome is ok; everything else is thrown.
  DrawReply draw(const DrawRequest& request, const SharedMemory& frame);

 private:
  enum class Depth { less, equal };
  void submit(const DrawRequest& request, const Program& program, Depth depth);
  double timed_milliseconds(const DrawRequest& request);
  void capture(const DrawRequest& request, std::byte* planes);

  const GlFunctions& gl_;
  ProgramCache programs_;
  DrawData data_;
  std::unique_ptr<RenderTargets> targets_;
};

}  // namespace twinshade::gl
