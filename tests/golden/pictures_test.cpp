#include "golden/pictures.h"

#include <OpenImageIO/imageio.h>

#include <doctest/doctest.h>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <filesystem>
#include <limits>
#include <thread>

#include <unistd.h>

#include "base/error.h"
#include "base/file.h"
#include "images/image_file.h"

namespace twinshade {
namespace {

namespace fs = std::filesystem;

struct Folder {
  fs::path path = fs::temp_directory_path() / ("twinshade_pictures_" + std::to_string(::getpid()));
  Folder() { fs::create_directories(path); }
  ~Folder() { fs::remove_all(path); }
  std::string file(const char* name) const { return (path / name).string(); }
  std::size_t count() const {
    return std::size_t(std::distance(fs::directory_iterator(path), fs::directory_iterator()));
  }
};

Frame frame_of(std::uint32_t width, std::uint32_t height) {
  Frame frame;
  frame.width = width, frame.height = height;
  const std::size_t pixels = std::size_t(width) * height;
  frame.coverage.assign(pixels, 1);
  frame.primitive_id.assign(pixels, 0);
  frame.depth.assign(pixels, 0.5f);
  for (std::size_t i = 0; i < pixels * 4; ++i) frame.color.push_back(0.001f * float(i) - 0.01f);
  return frame;
}

struct Image {
  int width = 0, height = 0, channels = 0;
  std::vector<float> values;
};

Image read(const std::string& path) {
  auto in = OIIO::ImageInput::open(path);
  REQUIRE_MESSAGE(in, OIIO::geterror());
  Image image{in->spec().width, in->spec().height, in->spec().nchannels, {}};
  image.values.resize(std::size_t(image.width) * image.height * image.channels);
  REQUIRE(in->read_image(0, 0, 0, image.channels, OIIO::TypeDesc::FLOAT, image.values.data()));
  return image;
}

}  // namespace

TEST_CASE("EXR keeps every bit of the colour, top row first") {
  const Folder folder;
  Frame frame = frame_of(5, 3);
  frame.color[0] = std::numeric_limits<float>::denorm_min();
  frame.color[1] = std::numeric_limits<float>::infinity();
  frame.color[2] = -0.0f;
  write_picture(folder.file("a.exr"), frame, {.notes = {{"technique", "h4"}}});
  const Image image = read(folder.file("a.exr"));
  REQUIRE(image.channels == 4);
  for (std::size_t y = 0; y < 3; ++y)
    CHECK(std::memcmp(&image.values[(2 - y) * 5 * 4], &frame.color[y * 5 * 4], 5 * 4 * sizeof(float)) == 0);
  CHECK(folder.count() == 1);
}

TEST_CASE("the same picture is the same bytes whenever it is written") {
  const Folder folder;
  const Frame frame = frame_of(5, 3);
  for (const char* name : {"a.exr", "a.png"}) {
    write_picture(folder.file(name), frame, {});
    const std::string first = read_file(folder.file(name));
    std::this_thread::sleep_for(std::chrono::milliseconds(1100));  // files tell seconds
    write_picture(folder.file(name), frame, {});
    CHECK(read_file(folder.file(name)) == first);
  }
}

TEST_CASE("HDR keeps radiance to its shared exponent's precision and has no negative values") {
  const Folder folder;
  const Frame frame = frame_of(9, 4);
  write_picture(folder.file("a.hdr"), frame);
  const Image image = read(folder.file("a.hdr"));
  REQUIRE(image.channels == 3);
  for (std::size_t y = 0; y < 4; ++y)
    for (std::size_t x = 0; x < 9; ++x) {
      const float* expected = &frame.color[(y * 9 + x) * 4];
      const float largest = std::max({expected[0], expected[1], expected[2], 0.0f});
      for (std::size_t c = 0; c < 3; ++c) {
        CAPTURE(expected[c]);
        CHECK(std::abs(image.values[((3 - y) * 9 + x) * 3 + c] - std::max(expected[c], 0.0f)) <= largest / 128);
      }
    }
}

TEST_CASE("PNG is sRGB") {
  CHECK(display_value(0, 0, Tonemap::none) == 0);
  CHECK(display_value(1, 0, Tonemap::none) == 255);
  CHECK(display_value(0.5, 0, Tonemap::none) == 188);      // IEC 61966-2-1: 0.7354
  CHECK(display_value(0.21586, 0, Tonemap::none) == 128);  // the linear value of 128 / 255
  CHECK(display_value(0.25, 1, Tonemap::none) == 188);     // one stop up
  CHECK(display_value(1, 0, Tonemap::reinhard) == 188);    // 1 / (1 + 1)
  CHECK(display_value(NAN, 0, Tonemap::none) == 0);
  CHECK(display_value(-1, 0, Tonemap::aces) == 0);
  for (const Tonemap tonemap : {Tonemap::none, Tonemap::reinhard, Tonemap::aces}) {
    for (const double bright : {1e20, 1e150, 1e160, 1e308, std::numeric_limits<double>::infinity()}) {
      CAPTURE(bright);
      CHECK(display_value(bright, 0, tonemap) == 255);
    }
    CHECK(display_value(1e30, 900, tonemap) == 255);  // an exposure that takes it beyond the curves' squares
    int last = 0;
    for (double v = 0; v < 40; v += 0.01) {  // a tone curve never darkens what is brighter
      const int now = display_value(v, 0, tonemap);
      CHECK(now >= last);
      last = now;
    }
  }
}

TEST_CASE("integers are themselves: in PNG from 0 to 255, in EXR all, in HDR none") {
  const Folder folder;
  for (const Scalar scalar : {Scalar::u32, Scalar::i32}) {
    Frame frame = frame_of(2, 2);
    frame.color_scalar = scalar;
    const std::uint32_t words[16] = {0,   1,           254, 7, 255,         256, 0xffffffffu, 8,
                                     100, 0x80000000u, 3,   9, 0x7f800001u, 2,   5,           6};
    for (std::size_t i = 0; i < 16; ++i) frame.color[i] = std::bit_cast<float>(words[i]);
    write_picture(folder.file("a.png"), frame);
    const Image png = read(folder.file("a.png"));
    write_picture(folder.file("a.exr"), frame);
    const ChannelImage exr = read_channel_file(folder.file("a.exr"));
    REQUIRE(exr.channels.size() == 4);
    for (std::size_t y = 0; y < 2; ++y)
      for (std::size_t x = 0; x < 2; ++x)
        for (std::size_t c = 0; c < 4; ++c) {
          const std::uint32_t word = words[(y * 2 + x) * 4 + c];
          const std::size_t pixel = (1 - y) * 2 + x, place = exr.find(std::string_view(&"RGBA"[c], 1));
          REQUIRE(place < 4);
          CHECK_FALSE(exr.channels[place].is_float);
          CHECK(exr.words[pixel * 4 + place] == word);
          const bool negative = scalar == Scalar::i32 && word > 0x7fffffffu;
          if (c < 3) CHECK(png.values[pixel * 3 + c] * 255 == doctest::Approx(negative ? 0 : std::min(word, 255u)));
        }
    CHECK_THROWS_WITH_AS(write_picture(folder.file("a.hdr"), frame), doctest::Contains("name an .exr"), UserError);
    write_difference_picture(folder.file("d.png"), frame, frame);
    CHECK(read(folder.file("d.png")).values[0] * 255 == doctest::Approx(100 / 3));
  }
}

TEST_CASE("every linear value becomes the nearest of sRGB's 256 values") {
  double largest_error = 0;
  for (int i = 1; i < 1 << 20; ++i) {
    const double linear = i / double(1 << 20);
    const double expected = 255 * (linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1 / 2.4) - 0.055);
    largest_error = std::max(largest_error, std::abs(display_value(linear, 0, Tonemap::none) - expected));
  }
  CHECK(largest_error <= 0.5 + 1e-9);
}

TEST_CASE("a picture that cannot be written is refused by name and leaves nothing") {
  const Folder folder;
  const Frame frame = frame_of(2, 2);
  CHECK_THROWS_WITH_AS(write_picture("/nonexistent/x.exr", frame), doctest::Contains("/nonexistent"), UserError);
  CHECK_THROWS_WITH_AS(write_picture(folder.file("a.bmp"), frame), doctest::Contains(".exr, .hdr or .png"), UserError);
  fs::create_directories(folder.path / "taken.png");
  CHECK_THROWS_AS(write_picture(folder.file("taken.png"), frame), UserError);
  CHECK(folder.count() == 1);
}

TEST_CASE("the picture of differences shows layer and size at the pixel, y up") {
  const Folder folder;
  Frame a = frame_of(8, 1);
  for (float& v : a.color) v = 1;
  Frame b = a;
  b.color[1 * 4] = std::nextafter(1.0f, 2.0f);
  b.color[2 * 4] = 2.0f;
  b.color[3 * 4] = NAN;
  b.depth[4] = 0.25f;
  b.primitive_id[5] = 9;
  b.coverage[6] = 0;
  write_difference_picture(folder.file("d.png"), a, b);
  const Image image = read(folder.file("d.png"));
  const auto pixel = [&](std::size_t x) { return &image.values[x * 3]; };
  CHECK(pixel(0)[0] == pixel(0)[2]);                                // grey
  CHECK(pixel(1)[2] > pixel(1)[0]);                                 // blue
  CHECK((pixel(2)[0] > pixel(2)[1] && pixel(2)[0] > pixel(2)[2]));  // red
  CHECK((pixel(3)[0] == 1 && pixel(3)[1] == 1 && pixel(3)[2] == 1));
  CHECK((pixel(4)[0] == 0 && pixel(4)[1] > 0.5f));
  CHECK((pixel(5)[0] == 1 && pixel(5)[2] == 0));
  CHECK((pixel(6)[0] == 1 && pixel(6)[1] == 0 && pixel(6)[2] == 1));
  CHECK(pixel(7)[0] == pixel(0)[0]);
}

TEST_CASE(
    "the picture of differences between integers shows how far apart they are, not what their bits are as floats") {
  const Folder folder;
  const auto bits = [](std::int32_t value) { return std::bit_cast<float>(value); };
  Frame a = frame_of(3, 1);
  a.color_scalar = Scalar::i32;
  for (float& v : a.color) v = bits(0);
  Frame b = a;
  b.color[0] = bits(-1);       // a NaN, were it a float
  b.color[4] = bits(1 << 20);  // denormals
  b.color[8] = bits(1), a.color[8] = bits(-1);
  write_difference_picture(folder.file("d.png"), a, b);
  const Image image = read(folder.file("d.png"));
  const auto pixel = [&](std::size_t x) { return &image.values[x * 3]; };
  CHECK((pixel(0)[2] == 1 && pixel(0)[0] < 0.5f));                  // blue: 1
  CHECK((pixel(1)[0] > pixel(1)[1] && pixel(1)[0] > pixel(1)[2]));  // red: 2^16 and more
  CHECK(pixel(2)[0] < 0.5f);                                        // 2
}

}  // namespace twinshade
