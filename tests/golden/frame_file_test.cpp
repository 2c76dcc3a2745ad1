#include "golden/frame_file.h"

#include <OpenImageIO/imageio.h>

#include <doctest/doctest.h>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <random>
#include <thread>

#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "images/image_file.h"
#include "tests/scenes/temporary_folder.h"

namespace twinshade {
namespace {

float from_bits(std::uint32_t bits) { return std::bit_cast<float>(bits); }

// Every word of colour and depth is any bit pattern; some pixels are not covered.
Frame any_frame(std::uint32_t width, std::uint32_t height, Scalar scalar) {
  std::mt19937 random(7);
  Frame frame;
  frame.width = width, frame.height = height, frame.color_scalar = scalar;
  for (std::uint32_t i = 0; i < width * height; ++i) {
    for (int c = 0; c < 4; ++c) frame.color.push_back(from_bits(std::uint32_t(random())));
    frame.depth.push_back(from_bits(std::uint32_t(random())));
    frame.coverage.push_back(random() % 2);
    frame.primitive_id.push_back(frame.coverage.back() ? std::uint32_t(random()) : kNoPrimitive);
  }
  constexpr std::uint32_t kSpecial[] = {0x7fc00000, 0xffc01234, 0x7f800001, 0xff812345, 0x80000000, 0x00000001,
                                        0x807fffff, 0x7f800000, 0xff800000, 0x7f7fffff, 0x00000000, 0xffffffff};
  for (std::size_t i = 0; i < std::size(kSpecial); ++i) {
    frame.color[i] = from_bits(kSpecial[i]);
    frame.depth[i] = from_bits(kSpecial[i]);
  }
  return frame;
}

template <class T>
bool same_bytes(const T& a, const T& b) {
  return a.size() == b.size() && std::memcmp(a.data(), b.data(), a.size() * sizeof(a[0])) == 0;
}

}  // namespace

TEST_CASE("a frame comes back from its file bit for bit, whatever its bits are") {
  const TemporaryFolder folder;
  for (const Scalar scalar : {Scalar::f32, Scalar::i32, Scalar::u32})
    for (const auto& [width, height] : {std::pair(13u, 7u), std::pair(1u, 12u), std::pair(40u, 1u)}) {
      CAPTURE(int(scalar));
      const Frame frame = any_frame(width, height, scalar);
      const std::string path = folder.name("a.exr");
      write_frame_file(path, frame);
      const Frame read = read_frame_file(path);
      CHECK(read.width == width);
      CHECK(read.height == height);
      CHECK(read.color_scalar == scalar);
      CHECK(same_bytes(read.color, frame.color));
      CHECK(same_bytes(read.depth, frame.depth));
      CHECK(same_bytes(read.primitive_id, frame.primitive_id));
      CHECK(same_bytes(read.coverage, frame.coverage));
    }
}

TEST_CASE("other tools find the frame's channels by their names, upper row first") {
  const TemporaryFolder folder;
  const Frame frame = any_frame(5, 3, Scalar::f32);
  write_frame_file(folder.name("a.exr"), frame);
  const auto in = OIIO::ImageInput::open(folder.name("a.exr"));
  REQUIRE(in);
  const OIIO::ImageSpec& spec = in->spec();
  CHECK(spec.get_string_attribute("compression") == "zip");
  REQUIRE(spec.nchannels == 7);
  for (const char* name : {"R", "G", "B", "A", "Z", "id", "coverage"}) {
    CAPTURE(name);
    const int channel = spec.channelindex(name);
    REQUIRE(channel >= 0);
    const bool whole = std::string(name) == "id" || std::string(name) == "coverage";
    CHECK(spec.channelformat(channel) == (whole ? OIIO::TypeDesc::UINT32 : OIIO::TypeDesc::FLOAT));
  }
  std::vector<float> depth(15);
  REQUIRE(
      in->read_image(0, 0, spec.channelindex("Z"), spec.channelindex("Z") + 1, OIIO::TypeDesc::FLOAT, depth.data()));
  CHECK(std::memcmp(&depth[0], &frame.depth[10], 5 * sizeof(float)) == 0);
}

TEST_CASE("the same frame is the same bytes whenever it is written") {
  const TemporaryFolder folder;
  const Frame frame = any_frame(9, 4, Scalar::f32);
  write_frame_file(folder.name("a.exr"), frame);
  std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // files tell seconds
  write_frame_file(folder.name("b.exr"), frame);
  CHECK(read_file(folder.name("a.exr")) == read_file(folder.name("b.exr")));
}

TEST_CASE("what is no frame is refused by name, with the reason") {
  const TemporaryFolder folder;
  const auto refused = [&](const std::string& bytes, const char* reason) {
    write_file(folder.name("a.exr"), bytes);
    CHECK_THROWS_WITH_AS(read_frame_file(folder.name("a.exr")), doctest::Contains(reason), UserError);
    CHECK_THROWS_WITH_AS(read_frame_file(folder.name("a.exr")), doctest::Contains("a.exr"), UserError);
  };
  refused("", "empty");
  refused("P5 1 1 255 x", "no OpenEXR file");
  write_frame_file(folder.name("good.exr"), any_frame(64, 64, Scalar::f32));
  const std::string good = read_file(folder.name("good.exr"));
  refused(good.substr(0, good.size() / 2), "");
  for (std::size_t at = 0; at < good.size(); at += 97) {  // damage anywhere: refused, or another frame; no crash
    std::string damaged = good;
    damaged[at] = char(~damaged[at]);
    write_file(folder.name("a.exr"), damaged);
    try {
      read_frame_file(folder.name("a.exr"));
    } catch (const UserError&) {
    }
  }
  const std::vector<float> grey(4, 0.5f);
  write_image_file(folder.name("picture.exr"), {2, 2, 1, true, grey.data(), 8, {}});
  CHECK_THROWS_WITH_AS(read_frame_file(folder.name("picture.exr")), doctest::Contains("not a frame"), UserError);
  const auto out = OIIO::ImageOutput::create(folder.name("half.exr"));
  REQUIRE(out->open(folder.name("half.exr"), OIIO::ImageSpec(2, 2, 1, OIIO::TypeDesc::HALF)));
  REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, grey.data()));
  REQUIRE(out->close());
  CHECK_THROWS_WITH_AS(read_frame_file(folder.name("half.exr")), doctest::Contains("not of 32 bits"), UserError);
  CHECK_THROWS_AS(read_frame_file(folder.name("missing.exr")), UserError);
  CHECK_THROWS_AS(write_frame_file("/nonexistent/a.exr", any_frame(4, 4, Scalar::f32)), UserError);
}

}  // namespace twinshade
