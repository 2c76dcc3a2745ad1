// Workers: what survives, what is reported, what is not sent twice.
#include <doctest/doctest.h>
#include <signal.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <limits>
#include <thread>

#include "base/error.h"
#include "raster/gl/gl_renderer.h"
#include "tests/gl/test_bundles.h"
#include "tests/gl/test_shaders.h"

using namespace twinshade;
using test::error_of;
using test::shader;

namespace {

const char* const kPlain = "in vec2 v_uv; out vec4 c; void main() { c = vec4(v_uv, 0.0, 1.0); }";

// Work for minutes on many_pixels(): llvmpipe ends loops after 65,535 turns, so it takes many pixels too.
const char* const kEndless = R"(
in vec2 v_uv;
out vec4 c;
void main() {
  vec4 x = v_uv.xyxy;
  for (int i = 0; i < 60000; ++i) x = sqrt(x.yzwx * 0.999 + sqrt(x + float(i)));
  c = x;
})";
Bundle many_pixels() { return test::quad(2048, 2048); }

std::vector<pid_t> children(pid_t parent = getpid()) {
  const std::string id = std::to_string(parent);
  std::ifstream file("/proc/" + id + "/task/" + id + "/children");
  std::vector<pid_t> result;
  for (pid_t pid = 0; file >> pid;) result.push_back(pid);
  return result;
}

// A process that nobody has waited for yet is none.
bool runs(pid_t pid) {
  std::ifstream file("/proc/" + std::to_string(pid) + "/stat");
  std::string line;
  std::getline(file, line);
  return !line.empty() && line.compare(line.rfind(')') + 1, 2, " Z") != 0;
}

// Within ten seconds.
bool becomes(const std::function<bool()>& condition) {
  for (int attempt = 0; attempt < 500 && !condition(); ++attempt) usleep(20000);
  return condition();
}

bool contains(const std::string& text, const std::string& part) { return text.find(part) != std::string::npos; }

double seconds_of(const std::function<void()>& call) {
  const auto start = std::chrono::steady_clock::now();
  call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

}  // namespace

TEST_CASE("a worker lives on between draws and is gone with its renderer") {
  const std::size_t before = children().size();
  {
    const auto renderer = make_gl_renderer(GlBackend::egl);
    CHECK(children().size() == before);
    renderer->draw(test::quad(8, 8), shader(kPlain), {});
    const auto during = children();
    CHECK(during.size() == before + 1);
    renderer->draw(test::quad(16, 8), shader(kPlain), {});
    renderer->draw(test::quad(16, 8), shader("out vec4 c; void main() { c = vec4(1.0); }"), {});
    CHECK(children() == during);
  }
  CHECK(children().size() == before);
}

TEST_CASE("frames follow the bundle, whatever of it changes") {
  const auto renderer = make_gl_renderer(GlBackend::egl);
  Bundle bundle = test::quad(8, 8);
  bundle.uniforms = {{"k", Scalar::f32, 1, 1, 0, {1}}};
  bundle.textures = {{"map", TextureKind::two_d, 1, 1, 1, Filter::nearest, Wrap::repeat, {5, 5, 5, 5}}};
  const ShaderSource source = shader(
      "in vec2 v_uv; uniform float k; uniform sampler2D map; out vec4 c; void main() { c = vec4(v_uv.x, k, "
      "texelFetch(map, "
      "ivec2(0), 0).x, 0); }");
  const auto draw = [&] { return renderer->draw(bundle, source, {}); };
  const Frame first = draw();
  CHECK(first.color[1] == 1);
  CHECK(first.color[2] == 5);
  CHECK(frame_hash(draw()) == frame_hash(first));
  bundle.uniforms[0].values[0] = 2;
  CHECK(draw().color[1] == 2);
  bundle.textures[0].texels[0] = 6;
  CHECK(draw().color[2] == 6);
  bundle.attributes[0].values.assign(8, 0.75f);
  CHECK(draw().color[0] == 0.75f);
  for (float& z : bundle.clip_positions) z *= 0.5f;
  for (std::size_t v = 0; v < 4; ++v) bundle.clip_positions[v * 4 + 3] = 1;
  CHECK(draw().coverage[0] == 0);
}

TEST_CASE("a hang is ended at the time limit, and the next draw works") {
  const auto renderer = make_gl_renderer(GlBackend::egl);
  DrawOptions options;
  options.time_limit_seconds = 2;
  std::string error;
  const double seconds =
      seconds_of([&] { error = error_of([&] { renderer->draw(many_pixels(), shader(kEndless), options); }); });
  CHECK(error == "egl: no answer within 2 s, so the worker was ended");
  CHECK(seconds < 4);
  CHECK(renderer->draw(test::quad(8, 8), shader(kPlain), {}).coverage[0] == 1);
}

TEST_CASE("a time limit longer than any clock holds is none") {
  DrawOptions options;
  options.time_limit_seconds = 1e300;
  CHECK(make_gl_renderer(GlBackend::egl)->draw(test::quad(8, 8), shader(kPlain), options).coverage[0] == 1);
}

TEST_CASE("a worker whose parent is killed ends, though it is drawing") {
  const pid_t parent = fork();
  REQUIRE(parent >= 0);
  if (parent == 0) {
    make_gl_renderer(GlBackend::egl)->draw(many_pixels(), shader(kEndless), {});
    _exit(0);
  }
  std::vector<pid_t> workers;
  CHECK(becomes([&] { return !(workers = children(parent)).empty(); }));
  usleep(1000000);  // it draws by now
  kill(parent, SIGKILL);
  waitpid(parent, nullptr, 0);
  for (const pid_t worker : workers) CHECK(becomes([&] { return !runs(worker); }));
}

TEST_CASE("a crash while drawing is one error, and the next draw works") {
  for (const GlBackend backend : {GlBackend::egl, GlBackend::osmesa}) {
    const auto renderer = make_gl_renderer(backend);
    const auto before = children();
    renderer->draw(test::quad(8, 8), shader(kPlain), {});
    REQUIRE(children().size() == before.size() + 1);
    const pid_t worker = children().back();
    std::thread assassin([&] {
      std::this_thread::sleep_for(std::chrono::milliseconds(300));
      kill(worker, SIGSEGV);
    });
    const std::string error = error_of([&] { renderer->draw(many_pixels(), shader(kEndless), {}); });
    assassin.join();
    CHECK(error.find(renderer->name() + ": the driver crashed (SIGSEGV, Segmentation fault)") == 0);
    CHECK(renderer->draw(test::quad(8, 8), shader(kPlain), {}).coverage[0] == 1);
  }
}

TEST_CASE("a missing library is named, and the other backend still works") {
  GlEnvironment environment;
  environment.extra = {{"TWINSHADE_OSMESA_LIBRARY", "libOSMesa.so.99"}, {"TWINSHADE_EGL_LIBRARY", "libEGL.so.99"}};
  for (const GlBackend backend : {GlBackend::egl, GlBackend::osmesa}) {
    const auto renderer = make_gl_renderer(backend, environment);
    const std::string error = error_of([&] { renderer->draw(test::quad(8, 8), shader(kPlain), {}); });
    CHECK(contains(error, renderer->name() + ": cannot load lib"));
    CHECK(contains(error, ".so.99: cannot open shared object file"));
  }
  CHECK(make_gl_renderer(GlBackend::egl)->draw(test::quad(8, 8), shader(kPlain), {}).coverage[0] == 1);
}

TEST_CASE("a worker that cannot be started for want of descriptors is one missing backend") {
  const auto renderer = make_gl_renderer(GlBackend::egl);
  rlimit before{};
  REQUIRE(getrlimit(RLIMIT_NOFILE, &before) == 0);
  const int lowest = dup(0);  // what is open stays; a socket is two more
  REQUIRE(lowest >= 0);
  close(lowest);
  const rlimit two_more{rlim_t(lowest) + 2, before.rlim_max};
  REQUIRE(setrlimit(RLIMIT_NOFILE, &two_more) == 0);
  const std::string error = error_of([&] { renderer->draw(test::quad(8, 8), shader(kPlain), {}); });
  REQUIRE(setrlimit(RLIMIT_NOFILE, &before) == 0);
  CHECK(error == "egl: cannot make shared memory: Too many open files");
}

TEST_CASE("a program that is no worker is reported, not waited for") {
  setenv("TWINSHADE_WORKER", "/bin/false", 1);
  const auto renderer = make_gl_renderer(GlBackend::egl);
  CHECK(error_of([&] { renderer->draw(test::quad(8, 8), shader(kPlain), {}); }) ==
        "egl: the worker ended by itself with exit code 1");
  setenv("TWINSHADE_WORKER", "/nonexistent/worker", 1);
  CHECK(contains(error_of([&] { renderer->draw(test::quad(8, 8), shader(kPlain), {}); }),
                 "egl: cannot start the worker /nonexistent"));
  unsetenv("TWINSHADE_WORKER");
}

TEST_CASE("a graphics card that is not there is refused, and a device of EGL's list draws") {
  GlEnvironment nowhere, first;
  nowhere.extra = {{"TWINSHADE_GPU", "99"}};
  first.extra = {{"TWINSHADE_GPU", "0"}};  // Mesa's processor where there is no card
  CHECK(
      contains(error_of([&] { make_gl_renderer(GlBackend::gpu, nowhere)->draw(test::quad(8, 8), shader(kPlain), {}); }),
               "gpu: TWINSHADE_GPU=99 is none among the"));
  const Frame frame = make_gl_renderer(GlBackend::gpu, first)->draw(test::quad(8, 8), shader(kPlain), {});
  CHECK(frame.color == make_gl_renderer(GlBackend::egl)->draw(test::quad(8, 8), shader(kPlain), {}).color);
}

TEST_CASE("the worker's environment is its own") {
  setenv("LP_NUM_THREADS", "99", 1);
  setenv("GALLIUM_DRIVER", "softpipe", 1);
  GlEnvironment environment;
  environment.threads = 1;
  environment.host_fma = false;  // shows in the width of llvmpipe's vectors
  const Frame frame = make_gl_renderer(GlBackend::egl, environment)->draw(test::quad(8, 8), shader(kPlain), {});
  unsetenv("LP_NUM_THREADS");
  unsetenv("GALLIUM_DRIVER");
  const auto recorded = [&](const std::string& key) {
    for (const auto& [name, value] : frame.provenance)
      if (name == key) return value;
    return std::string("nothing");
  };
  CHECK(contains(recorded("GL_RENDERER"), "llvmpipe"));
  CHECK(contains(recorded("GL_RENDERER"), "128 bits"));
  CHECK(contains(recorded("GL_VERSION"), "4.5"));
  CHECK(recorded("LP_NUM_THREADS") == "1");
}

TEST_CASE("positions that are not finite draw nothing and harm nobody") {
  const float infinity = std::numeric_limits<float>::infinity(), nan = std::numeric_limits<float>::quiet_NaN();
  Bundle bundle = test::quad(16, 16);
  for (const float bad : {nan, infinity, -infinity, -nan})
    for (std::size_t component = 0; component < 4; ++component) {
      const auto vertex = std::uint32_t(bundle.vertex_count());
      for (std::size_t c = 0; c < 4; ++c) bundle.clip_positions.push_back(c == component ? bad : -0.5f);
      bundle.attributes[0].values.insert(bundle.attributes[0].values.end(), {9, 9});
      bundle.indices.insert(bundle.indices.begin(), {0, 1, vertex, vertex, vertex, vertex, 2, vertex, 3});
    }
  for (const GlBackend backend : {GlBackend::egl, GlBackend::osmesa}) {
    const Frame frame = make_gl_renderer(backend)->draw(bundle, shader(kPlain), {});
    for (std::size_t p = 0; p < 256; ++p) REQUIRE(frame.primitive_id[p] >= 48);
    CHECK(frame.color[0] == doctest::Approx(0.5 / 16));
  }
}

TEST_CASE("softpipe does not pretend to rasterize") {
  CHECK(contains(error_of([] { make_gl_renderer(GlBackend::softpipe)->draw(test::quad(8, 8), shader(kPlain), {}); }),
                 "softpipe: its coverage is not comparable"));
}
