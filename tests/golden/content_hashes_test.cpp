#include "golden/content_hashes.h"

#include <doctest/doctest.h>

#include "base/file.h"
#include "tests/scenes/temporary_folder.h"

namespace twinshade {
namespace {

const char* const kMain = "#include \"a.glsl\"\nout vec4 color;\nvoid main() { color = vec4(half_of(1.0)); }\n";
const char* const kIncluded = "float half_of(float x) { return 0.5 * x; }\n";

std::string hash_in(const std::string& folder, const std::string& main, const std::string& included) {
  write_file(folder + "/main.frag", main);
  write_file(folder + "/a.glsl", included);
  return content_hash(load_fragment_shader(folder + "/main.frag"));
}

}  // namespace

TEST_CASE("a shader's hash is that of its text and its includes' text, wherever they lie") {
  const TemporaryFolder here, there;
  const std::string hash = hash_in(here.path.string(), kMain, kIncluded);
  CHECK(hash.size() == 64);
  CHECK(hash_in(there.path.string(), kMain, kIncluded) == hash);
  CHECK(source_hash(load_fragment_shader(here.name("main.frag"))) !=
        source_hash(load_fragment_shader(there.name("main.frag"))));
  CHECK(hash_in(there.path.string(), kMain, "float half_of(float x) { return 0.25 * x; }\n") != hash);
  CHECK(hash_in(there.path.string(), std::string(kMain) + "// end\n", kIncluded) != hash);
  SourceOptions defined;
  defined.defines = {"A=1"};
  CHECK(content_hash(load_fragment_shader(here.name("main.frag"), defined)) != hash);
}

TEST_CASE("a bundle's hash leaves out where it came from, and nothing else") {
  Bundle bundle;
  bundle.width = 4, bundle.height = 2;
  bundle.clip_positions = {0, 0, 0, 1};
  const std::string hash = content_hash(bundle);
  bundle.notes = {{"environment", "/somewhere/probe.hdr"}};
  CHECK(content_hash(bundle) == hash);
  CHECK(bundle.notes.size() == 1);
  bundle.clip_positions[2] = -0.0f;
  CHECK(content_hash(bundle) != hash);
}

}  // namespace twinshade
