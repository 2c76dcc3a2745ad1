// A worker's life: make a context, say so, then draw for the parent until it closes the socket.
#include <poll.h>
#include <sys/resource.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstring>
#include <optional>
#include <system_error>
#include <thread>

#include "raster/gl/worker/failure.h"
#include "raster/gl/worker/frame_drawer.h"
#include "raster/gl/worker/gl_context.h"
#include "raster/gl/worker_process.h"

namespace twinshade {
namespace gl {
namespace {

std::string packed(const DrawReply& reply) {
  WireWriter writer;
  writer.put(reply);
  return writer.take();
}

DrawReply failure(Outcome outcome, const std::string& text) {
  DrawReply reply;
  reply.outcome = outcome;
  reply.text = text;
  return reply;
}

// A draw may take long after its parent was killed: its end of the socket closes, and nobody waits for this one.
void end_with_parent() try {
  std::thread([] {
    pollfd end{kWorkerSocket, POLLRDHUP, 0};
    while (poll(&end, 1, -1) < 0 && errno == EINTR) {
    }
    sleep(1);  // what is between draws ends by itself
    _exit(0);
  }).detach();
} catch (const std::system_error&) {  // no thread to be had: the alarm is left
}

// Should the parent hang as well, the alarm ends what a driver does not.
void limit_own_life(double time_limit_seconds) { alarm(unsigned(std::ceil(std::min(time_limit_seconds, 1e6))) + 10); }

int serve(GlBackend backend) {
  Channel channel{FileDescriptor(kWorkerSocket)};
  end_with_parent();
  std::unique_ptr<GlContext> context;
  try {
    context = make_context(backend);
  } catch (const std::exception& error) {
    channel.send(packed(failure(Outcome::backend_error, error.what())), {}, std::nullopt);
    return 1;
  }
  if (channel.send(packed({}), {}, std::nullopt) != ChannelState::ok) return 0;

  FrameDrawer drawer(context->functions());
  SharedMemory frame;
  Message message;
  while (channel.receive(message, std::nullopt) == ChannelState::ok) {
    DrawReply reply;
    try {
      DrawRequest request;
      WireReader(message.bytes).get(request);
      limit_own_life(request.time_limit_seconds);
      // Descriptors come in this order, each only where it is new: the bundle's image, the frame.
      std::size_t next = 0;
      if (request.new_image)
        drawer.data().replace(request.image, SharedMemory::map(std::move(message.descriptors.at(next++))));
      if (next < message.descriptors.size()) frame = SharedMemory::map(std::move(message.descriptors[next]));
      reply = request.frame.compute.empty() ? drawer.draw(request, frame) : drawer.dispatch(request, frame);
      reply.provenance = context->provenance();
    } catch (const Failure& error) {
      reply = failure(error.outcome, error.what());
    } catch (const std::exception& error) {
      reply = failure(Outcome::backend_error, error.what());
    }
    alarm(0);
    if (channel.send(packed(reply), {}, std::nullopt) != ChannelState::ok) break;
  }
  return 0;
}

}  // namespace
}  // namespace gl

std::optional<int> run_gl_worker_if_asked(int argc, char** argv) {
  gl::note_worker_entry();
  if (argc != 3 || std::strcmp(argv[1], gl::kWorkerArgument) != 0) return std::nullopt;
  const rlimit no_core_files{0, 0};
  setrlimit(RLIMIT_CORE, &no_core_files);
  for (const GlBackend backend : {GlBackend::egl, GlBackend::osmesa, GlBackend::softpipe, GlBackend::gpu})
    if (std::strcmp(argv[2], gl::backend_name(backend)) == 0) return gl::serve(backend);
  return 2;
}

}  // namespace twinshade
