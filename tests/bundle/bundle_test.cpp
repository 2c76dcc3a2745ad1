#include "bundle/bundle.h"

#include <doctest/doctest.h>

#include <cstring>
#include <filesystem>
#include <limits>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "base/memory.h"

using namespace twinshade;

namespace {

Bundle small_bundle() {
  Bundle bundle;
  bundle.width = 5;
  bundle.height = 3;
  bundle.clip_positions = {-1, -1, 0, 1, 1, -1, 0, 1, 0, 1, -0.0f, 1};
  bundle.indices = {0, 1, 2};
  bundle.attributes = {{"v_uv", Scalar::f32, 2, {0, 0, 1, 0, 0.5f, std::numeric_limits<float>::quiet_NaN()}},
                       {"v_material", Scalar::i32, 1, {0, 0, 0}}};
  bundle.textures = {{"map", TextureKind::two_d, 2, 1, 1, Filter::nearest, Wrap::repeat, {0, 1, 2, 3, 4, 5, 6, 7}}};
  bundle.uniforms = {{"k", Scalar::f32, 1, 3, 2, {1, 2, 3, 4, 5, 6}}};
  bundle.buffers = {{"Block", true, {std::byte{1}, std::byte{2}}}};
  bundle.notes = {{"scene", "test"}};
  return bundle;
}

std::string error_of(const std::string& bytes) {
  try {
    deserialize(bytes, "f.bundle");
  } catch (const UserError& error) {
    return error.what();
  }
  return "no error";
}

}  // namespace

TEST_CASE("SHA-256 gives the digests of FIPS 180-4's examples") {
  CHECK(sha256_hex("abc") == "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
  CHECK(sha256_hex("") == "e3b0c44298fc1c149afbf4c8996fb92427ae41e4649b934ca495991b7852b855");
  CHECK(sha256_hex("abcdbcdecdefdefgefghfghighijhijkijkljklmklmnlmnomnopnopq") ==
        "248d6a61d20638b8e5c026930c3e6039a33ce45964ff2167f6ecedd419db06c1");
  Sha256 in_parts;
  const std::string million(1000000, 'a');
  for (std::size_t at = 0, step = 1; at < million.size(); at += step, step = step * 7 % 131 + 1)
    in_parts.add(std::string_view(million).substr(at, step));
  CHECK(in_parts.hex() == "cdc76e5c9914fb9281a1c7e284d73e67f1809a48a497200e046d39ccc7112cd0");
}

TEST_CASE("a bundle survives the way to bytes and back, to the bit") {
  const Bundle bundle = small_bundle();
  const std::string bytes = serialize(bundle);
  CHECK(serialize(deserialize(bytes, "memory")) == bytes);
  CHECK(bundle_hash(bundle).size() == 64);
  Bundle other = bundle;
  other.clip_positions[10] = 0.0f;  // was -0
  CHECK(bundle_hash(other) != bundle_hash(bundle));
}

TEST_CASE("a truncated or damaged bundle is refused in one line that names the file") {
  const std::string bytes = serialize(small_bundle());
  for (std::size_t length = 0; length < bytes.size(); ++length) {
    const std::string error = error_of(bytes.substr(0, length));
    CHECK_MESSAGE(error.rfind("f.bundle: ", 0) == 0, error);
    CHECK(error.find('\n') == std::string::npos);
  }
  std::string damaged = bytes;
  damaged[bytes.size() / 2] = char(damaged[bytes.size() / 2] ^ 1);
  CHECK(error_of(damaged).find("hash") != std::string::npos);
  std::string newer = bytes;
  ++newer[7];
  CHECK(error_of(newer).find("another version") != std::string::npos);
}

TEST_CASE("a bundle whose parts do not fit together is refused") {
  Bundle bundle = small_bundle();
  bundle.indices[1] = 3;
  CHECK_THROWS_WITH_AS(validate(bundle, "b"), doctest::Contains("vertex index 3"), UserError);
  bundle = small_bundle();
  bundle.attributes[0].values.pop_back();
  CHECK_THROWS_WITH_AS(validate(bundle, "b"), doctest::Contains("v_uv"), UserError);
  bundle = small_bundle();
  bundle.width = 16385;
  CHECK_THROWS_WITH_AS(validate(bundle, "b"), doctest::Contains("16384"), UserError);
  bundle = small_bundle();
  bundle.textures[0].kind = TextureKind::cube;
  CHECK_THROWS_WITH_AS(validate(bundle, "b"), doctest::Contains("map"), UserError);
  for (const auto& change : std::vector<void (*)(Bundle&)>{
           [](Bundle& b) { b.textures[0].kind = TextureKind(3); }, [](Bundle& b) { b.textures[0].filter = Filter(77); },
           [](Bundle& b) { b.textures[0].wrap = Wrap(255); }, [](Bundle& b) { b.attributes[0].scalar = Scalar(4); },
           [](Bundle& b) {  // 2^64 texels' floats, which is none
             b.textures[0].width = b.textures[0].height = 0x80000000u, b.textures[0].layers = 1;
             b.textures[0].kind = TextureKind::two_d, b.textures[0].texels.clear();
           }}) {
    bundle = small_bundle();
    change(bundle);
    CHECK_THROWS_AS(validate(bundle, "b"), UserError);
    CHECK_THROWS_AS(deserialize(serialize(bundle), "b"), UserError);
  }
}

TEST_CASE("a bundle with a control character in a name is refused: the message would end there") {
  for (const auto& change : std::vector<void (*)(Bundle&)>{[](Bundle& b) { b.attributes[0].name[1] = '\0'; },
                                                           [](Bundle& b) { b.textures[0].name += '\n'; },
                                                           [](Bundle& b) { b.uniforms[0].name += '\x7f'; }}) {
    Bundle bundle = small_bundle();
    change(bundle);
    CHECK_THROWS_WITH_AS(deserialize(serialize(bundle), "b"),
                         "b: damaged bundle: a name has a control character in it; bake it again", UserError);
  }
}

TEST_CASE("a count that a bundle has the bytes for but not the parts takes no memory for them") {
  Bundle bundle = small_bundle();
  bundle.attributes.clear(), bundle.textures.clear(), bundle.uniforms.clear(), bundle.notes.clear();
  bundle.buffers = {{"b", false, std::vector<std::byte>(std::size_t{16} << 20, std::byte{0xff})}};
  std::string bytes = serialize(bundle);
  const std::size_t attributes = 8 + 4 + 4 + 8 + bundle.clip_positions.size() * 4 + 8 + bundle.indices.size() * 4 + 1;
  const std::uint64_t claimed = std::uint64_t{16} << 20;
  std::memcpy(&bytes[attributes], &claimed, sizeof claimed);
  bytes.resize(bytes.size() - 64);
  bytes += sha256_hex(bytes);
  const std::uint64_t before = peak_memory();
  CHECK_THROWS_WITH_AS(deserialize(bytes, "b"), doctest::Contains("damaged bundle"), UserError);
  if (before != 0) CHECK(peak_memory() < before + (std::uint64_t{256} << 20));
}

TEST_CASE("fitting to the power-of-two viewport keeps every window position") {
  // A vertex at window position p of a 1280 x 800 viewport must land on p of the 2048 x 1024 one.
  std::vector<float> positions = {-2, 2, 0, 2, 3, -3, 0, 3, 0, 0, 0, 1, 0.25f, -0.5f, 0, -1};
  const std::vector<float> before = positions;
  fit_to_viewport(positions, 1280, 800);
  CHECK(viewport_size(1280, 800) == std::array<std::uint32_t, 2>{2048, 1024});
  CHECK(viewport_size(1, 16384) == std::array<std::uint32_t, 2>{1, 16384});
  for (std::size_t i = 0; i < positions.size(); i += 4) {
    const double w = before[i + 3];
    CHECK((positions[i] / w + 1) / 2 * 2048 == doctest::Approx((before[i] / w + 1) / 2 * 1280));
    CHECK((positions[i + 1] / w + 1) / 2 * 1024 == doctest::Approx((before[i + 1] / w + 1) / 2 * 800));
    CHECK(positions[i + 3] == before[i + 3]);
  }
}

TEST_CASE("nothing half-written appears under the final name") {
  const std::string folder = std::filesystem::temp_directory_path() / "twinshade_file_test";
  std::filesystem::create_directories(folder);
  const std::string path = folder + "/out.bin";
  write_file(path, "old");
  CHECK_THROWS(write_file_with(path, [](const std::string& temporary) {
    write_file(temporary, "half");
    throw UserError("stopped");
  }));
  CHECK(read_file(path) == "old");
  CHECK(std::distance(std::filesystem::directory_iterator(folder), std::filesystem::directory_iterator()) == 1);
  CHECK_THROWS_WITH_AS(write_file(folder + "/missing/x", "y"), doctest::Contains("does not exist"), UserError);
  CHECK_THROWS_WITH_AS(read_file(folder + "/missing"), doctest::Contains("missing"), UserError);
  std::filesystem::remove_all(folder);
}
