#include "scenes/environment.h"

#include <doctest/doctest.h>

#include <cmath>
#include <limits>
#include <map>
#include <random>

#include "base/file.h"
#include "base/portable_math.h"
#include "tests/scenes/image_writers.h"
#include "tests/scenes/temporary_folder.h"

using namespace twinshade;
using glm::dvec3;

namespace {

constexpr double kPi = portable::kPi;

Environment random_environment(std::uint32_t width, std::uint32_t height) {
  Environment environment{"random", width, height, {}};
  std::mt19937 random(5);
  for (std::uint32_t i = 0; i < width * height; ++i)
    environment.radiance.emplace_back(float(random() % 1000) / 100, float(random() % 1000) / 100,
                                      float(random() % 1000) / 100);
  return environment;
}

// About Y, counter-clockwise seen from above: +z towards +x.
dvec3 turned(const dvec3& d, double degrees) {
  const double a = degrees * kPi / 180, c = std::cos(a), s = std::sin(a);
  return {d.x * c + d.z * s, d.y, d.z * c - d.x * s};
}

}  // namespace

TEST_CASE("refining gives every pixel several of its radiance, and leaves what is fine enough as it is") {
  Environment environment{"small", 3, 2, {}};
  for (int i = 0; i < 6; ++i) environment.radiance.push_back(glm::vec3(float(i), 1, 2));
  const Environment fine = refine_environment(environment, 8, 5);
  CHECK(fine.width == 9);
  CHECK(fine.height == 6);
  for (std::uint32_t y = 0; y < 6; ++y)
    for (std::uint32_t x = 0; x < 9; ++x) CHECK(fine.radiance[y * 9 + x] == environment.radiance[y / 3 * 3 + x / 3]);
  CHECK(refine_environment(fine, 9, 6).radiance == fine.radiance);
  CHECK(refine_environment(environment, 0, 4).width == 3);
  const auto size = [](std::uint32_t width, std::uint32_t height) {
    const Environment small{"", width, height, std::vector<glm::vec3>(std::size_t(width) * height)};
    const Environment refined = refine_small_environment(small, 32);
    return glm::uvec2(refined.width, refined.height);
  };
  CHECK(size(64, 32) == glm::uvec2(64, 32));
  CHECK(size(63, 32) == glm::uvec2(189, 32));
  CHECK(size(64, 31) == glm::uvec2(64, 93));
  CHECK(size(1, 1) == glm::uvec2(128, 64));
}

TEST_CASE("environments of different sizes blend without losing light, whichever comes first") {
  // A sun of one pixel: between the pixel centres of all but the finest
  Environment sun{"sun", 160, 90, std::vector<glm::vec3>(160 * 90, glm::vec3(0.25f))};
  sun.radiance[31 * 160 + 55] = glm::vec3(1000, 500, 250);
  const auto flux = [](const Environment& e) {
    dvec3 sum(0);
    for (std::uint32_t y = 0; y < e.height; ++y)
      for (std::uint32_t x = 0; x < e.width; ++x) sum += dvec3(e.radiance[y * e.width + x]) * e.pixel_solid_angle(y);
    return sum;
  };
  for (const glm::uvec2 size : {glm::uvec2(1), glm::uvec2(64, 32), glm::uvec2(37, 200), glm::uvec2(512, 256)}) {
    const std::uint32_t width = size.x, height = size.y;
    CAPTURE(width);
    const Environment plain{"plain", width, height, std::vector<glm::vec3>(width * height, glm::vec3(2))};
    for (const double part : {0.0, 0.25, 1.0}) {
      const Environment there = blend_environments(plain, sun, part), back = blend_environments(sun, plain, 1 - part);
      CHECK(there.width == std::max(width, 160u));
      CHECK(there.height == std::max(height, 90u));
      CHECK(there.radiance == back.radiance);
      const dvec3 expected = flux(plain) * (1 - part) + flux(sun) * part, given = flux(there);
      for (int c = 0; c < 3; ++c) CHECK(given[c] == doctest::Approx(expected[c]).epsilon(1e-6));
    }
  }
  const Environment whole = blend_environments({"plain", 8, 4, std::vector<glm::vec3>(32)}, sun, 1);
  CHECK(whole.radiance == sun.radiance);
}

TEST_CASE("lat-long follows OpenEXR: zenith in row 0, longitude pi at the left edge") {
  const Environment e{"", 8, 4, std::vector<glm::vec3>(32)};
  const PixelDirections directions(8, 4);
  for (std::uint32_t y = 0; y < 4; ++y)
    for (std::uint32_t x = 0; x < 8; ++x) {
      const double longitude = kPi - 2 * kPi * (x + 0.5) / 8, latitude = kPi / 2 - kPi * (y + 0.5) / 4;
      const dvec3 expected(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                           std::cos(longitude) * std::cos(latitude));
      CHECK(glm::length(e.pixel_direction(x, y) - expected) < 1e-14);
      CHECK(std::fabs(glm::length(e.pixel_direction(x, y)) - 1) < 1e-15);
      CHECK(directions(x, y) == e.pixel_direction(x, y));
    }
  CHECK(e.pixel_direction(0, 0).y > 0.9);
}

TEST_CASE("solid angles of all pixels sum to 4 pi") {
  for (std::uint32_t height : {1u, 3u, 16u, 256u}) {
    const Environment e{"", 2 * height, height, {}};
    double sum = 0;
    for (std::uint32_t y = 0; y < height; ++y) sum += e.pixel_solid_angle(y) * e.width;
    CHECK(sum == doctest::Approx(4 * kPi).epsilon(1e-13));
  }
}

TEST_CASE("a lookup at a pixel's centre gives the pixel, halfway between two their mean") {
  const Environment e = random_environment(12, 6);
  for (std::uint32_t y = 0; y < e.height; ++y)
    for (std::uint32_t x = 0; x < e.width; ++x) {
      const dvec3 here(e.radiance[y * e.width + x]), right(e.radiance[y * e.width + (x + 1) % e.width]);
      CHECK(glm::length(e.radiance_towards(e.pixel_direction(x, y)) - here) < 1e-11);
      const double longitude = kPi - 2 * kPi * (x + 1.0) / e.width, latitude = kPi / 2 - kPi * (y + 0.5) / e.height;
      const dvec3 between(std::sin(longitude) * std::cos(latitude), std::sin(latitude),
                          std::cos(longitude) * std::cos(latitude));
      CHECK(glm::length(e.radiance_towards(between) - 0.5 * (here + right)) < 1e-11);
    }
  // Latitude is clamped at the poles.
  CHECK(std::isfinite(e.radiance_towards({0, 1, 0}).x));
  CHECK(std::isfinite(e.radiance_towards({0, -1, 0}).x));
}

TEST_CASE("rotation moves what was seen towards d to where d has turned, counter-clockwise from above") {
  const Environment e = random_environment(24, 12);
  for (double degrees : {15.0, 90.0, 225.0, -30.0, 735.0}) {  // whole pixels
    const Environment r = rotate_environment(e, degrees);
    for (std::uint32_t y = 0; y < e.height; ++y)
      for (std::uint32_t x = 0; x < e.width; ++x) {
        const dvec3 seen = r.radiance_towards(turned(e.pixel_direction(x, y), degrees));
        INFO(degrees << " degrees, pixel " << x << ", " << y);
        CHECK(glm::length(seen - dvec3(e.radiance[y * e.width + x])) < 1e-10);
      }
  }
  // A light in +z is found in +x after a quarter turn.
  Environment light{"", 4, 2, std::vector<glm::vec3>(8, glm::vec3(0))};
  for (std::uint32_t x = 0; x < 4; ++x)
    if (light.pixel_direction(x, 0).z > 0.1) light.radiance[x] = glm::vec3(1);
  const Environment quarter = rotate_environment(light, 90);
  for (std::uint32_t x = 0; x < 4; ++x) CHECK((quarter.radiance[x].x == 1) == (light.pixel_direction(x, 0).x > 0.1));
}

TEST_CASE("rotation by nothing or a full turn changes no bit; by parts of a pixel keeps the mean") {
  const Environment e = random_environment(24, 12);
  CHECK(environment_hash(rotate_environment(e, 0)) == environment_hash(e));
  CHECK(environment_hash(rotate_environment(e, -360)) == environment_hash(e));
  CHECK(environment_hash(rotate_environment(e, 15)) != environment_hash(e));
  const Environment r = rotate_environment(e, 7.3);
  for (std::uint32_t y = 0; y < e.height; ++y) {
    double before = 0, after = 0;
    for (std::uint32_t x = 0; x < e.width; ++x) before += e.radiance[y * 24 + x].x, after += r.radiance[y * 24 + x].x;
    CHECK(after == doctest::Approx(before).epsilon(1e-6));
  }
  CHECK(user_error([&] { rotate_environment(e, std::numeric_limits<double>::infinity()); }) != "");
}

TEST_CASE("painted environments are finite, not negative, and each what its name says") {
  for (const std::string& name : environment_names()) {
    const Environment e = load_environment(name);
    INFO(name);
    CHECK(e.name == name);
    REQUIRE(e.radiance.size() == std::size_t(e.width) * e.height);
    bool valid = true;
    for (const glm::vec3& c : e.radiance)
      for (int k = 0; k < 3; ++k) valid = valid && std::isfinite(c[k]) && c[k] >= 0;
    CHECK(valid);
    CHECK(environment_hash(load_environment(name)) == environment_hash(e));
  }
  const Environment sky = load_environment("sky");
  // The sun: irradiance 11 in its direction within the pixels around it, the brightest by far.
  double power = 0, brightest = 0;
  for (std::uint32_t y = 0; y < sky.height; ++y)
    for (std::uint32_t x = 0; x < sky.width; ++x) {
      const double c = sky.radiance[y * sky.width + x].x;
      brightest = std::max(brightest, c);
      if (c > 100) power += c * sky.pixel_solid_angle(y);
    }
  CHECK(power == doctest::Approx(11).epsilon(0.05));
  CHECK(brightest > 1000);
  for (const glm::vec3& c : load_environment("constant").radiance) CHECK(c == glm::vec3(1));
}

// Recorded so that any compiler, optimisation level or processor that gives other bits is caught.
TEST_CASE("painted and rotated environments have the same bits everywhere") {
  const std::map<std::string, std::string> expected = {
      {"sky", "95848a7bcd4b5232cbb26619ff8aa175ad490ec2946dedcc546ef2030dd1e0ce"},
      {"studio", "3c5a32cd4980af7d3b29bf7d938b40891493ea01ffc1b9c58ab58896dd3f009e"},
      {"window", "b119e8f1c3e673fa45a6c7fdab0c863f241328918d5980b563ccfa5adbdd22ce"},
      {"constant", "fd390047d4117b8625d13eba70612eae76fc4b0229413e4906fefe066c59027d"}};
  for (const std::string& name : environment_names())
    CHECK(environment_hash(rotate_environment(load_environment(name), 33.3)) == expected.at(name));
}

TEST_CASE("an .hdr file's mantissas are worth 2^(exponent - 136)") {
  TemporaryFolder folder;
  std::vector<std::uint8_t> rgbe;
  std::mt19937 random(2);
  const int width = 16, height = 8;
  for (int i = 0; i < width * height; ++i) {
    rgbe.push_back(std::uint8_t(128 | random()));  // normalised: no run-length marker either
    rgbe.push_back(std::uint8_t(random()));
    rgbe.push_back(std::uint8_t(random()));
    rgbe.push_back(std::uint8_t(100 + random() % 60));
  }
  for (int c = 0; c < 4; ++c) rgbe[4 * 20 + std::size_t(c)] = 0;  // black
  const Environment e = load_environment(folder.write("a.hdr", flat_rgbe(width, height, rgbe)));
  REQUIRE(e.width == 16);
  REQUIRE(e.height == 8);
  for (std::size_t i = 0; i < e.radiance.size(); ++i)
    for (int c = 0; c < 3; ++c) {
      INFO("pixel " << i << " channel " << c);
      CHECK(e.radiance[i][c] == float(std::ldexp(double(rgbe[4 * i + std::size_t(c)]), rgbe[4 * i + 3] - 136)));
    }
}

TEST_CASE("an .hdr file's values are divided by the product of its exposures and corrections") {
  TemporaryFolder folder;
  const std::string plain = flat_rgbe(8, 2, std::vector<std::uint8_t>(64, 130));
  const auto with = [&](const std::string& lines) {
    std::string text = plain;
    text.insert(text.find('\n') + 1, lines);
    return folder.write("e.hdr", text);
  };
  const glm::vec3 value = load_environment(with("")).radiance[0];
  CHECK(load_environment(with("EXPOSURE=8\nEXPOSURE= 0.25\n")).radiance[0] == value / 2.0f);
  CHECK(load_environment(with("EXPOSURE=2\nCOLORCORR=1 2 0.5\n")).radiance[0] ==
        glm::vec3(value.x / 2, value.y / 4, value.z));
  const std::string xyz = user_error([&] { load_environment(with("FORMAT=32-bit_rle_xyze\n")); });
  CHECK(xyz.find("e.hdr: cannot be read as an image: its colours are CIE XYZ") != std::string::npos);
  for (const char* bad : {"COLORCORR=1 2\n", "COLORCORR=1 0 1\n"})
    CHECK(user_error([&] { load_environment(with(bad)); }).find("its header says COLORCORR=") != std::string::npos);
  for (const char* bad : {"EXPOSURE=0\n", "EXPOSURE=-1\n", "EXPOSURE=x\n", "EXPOSURE=inf\n"}) {
    const std::string message = user_error([&] { load_environment(with(bad)); });
    INFO(message);
    CHECK(message.find("e.hdr: cannot be read as an image: its header says EXPOSURE=") != std::string::npos);
  }
}

TEST_CASE("an .hdr file with run lengths of the old kind is refused with the remedy") {
  TemporaryFolder folder;
  const std::string flat = flat_rgbe(16, 2, std::vector<std::uint8_t>(16 * 2 * 4, 1));
  CHECK_NOTHROW(load_environment(folder.write("flat.hdr", flat)));  // (1, 1, 1, 1) is a colour there
  const std::string header = flat.substr(0, flat.size() - 16 * 2 * 4), run = "\x80\x40\x20\x81\1\1\1\x0f";
  CHECK(user_error([&] { load_environment(folder.write("old.hdr", header + run + run)); }) ==
        folder.name("old.hdr") +
            ": cannot be read as an image: its pixels have run lengths of Radiance's old kind, which "
            "are not read; convert it with ra_rgbe");
  const std::string cut = user_error([&] { load_environment(folder.write("cut.hdr", header + run.substr(0, 4))); });
  CHECK_MESSAGE(cut.find("old kind") == std::string::npos, cut);
}

TEST_CASE("of an .exr file of several parts the first is read, and the others are named") {
  TemporaryFolder folder;
  const std::string path = folder.name("eyes.exr");
  std::vector<OIIO::ImageSpec> parts(3, OIIO::ImageSpec(4, 2, 3, OIIO::TypeDesc::FLOAT));
  const char* const names[] = {"left", "right", "depth"};
  for (std::size_t i = 0; i < 3; ++i) parts[i].attribute("oiio:subimagename", names[i]);
  const auto out = OIIO::ImageOutput::create(path);
  REQUIRE(out->open(path, 3, parts.data()));
  for (std::size_t i = 0; i < 3; ++i) {
    if (i > 0) REQUIRE(out->open(path, parts[i], OIIO::ImageOutput::AppendSubimage));
    const std::vector<float> values(4 * 2 * 3, float(i + 1));
    REQUIRE(out->write_image(OIIO::TypeDesc::FLOAT, values.data()));
  }
  REQUIRE(out->close());
  const Environment left = load_environment(path);
  CHECK(left.radiance[7] == glm::vec3(1));
  CHECK(left.note == path + ": of its 3 parts the first alone is read, left, not right, depth");
  write_image(folder.name("one.exr"), 4, 2, 3, std::vector<float>(24, 1.0f));
  CHECK(load_environment(folder.name("one.exr")).note.empty());
}

TEST_CASE("an .exr file is read as it is, row 0 at the zenith") {
  TemporaryFolder folder;
  std::vector<float> values;
  for (int i = 0; i < 6 * 4 * 3; ++i) values.push_back(float(i) * 0.37f);
  write_image(folder.name("a.exr"), 6, 4, 3, values, "zip");
  const Environment e = load_environment(folder.name("a.exr"));
  for (std::size_t i = 0; i < 24; ++i)
    for (std::size_t c = 0; c < 3; ++c) CHECK(e.radiance[i][int(c)] == values[3 * i + c]);
  write_image(folder.name("grey.exr"), 6, 4, 1, std::vector<float>(24, 2.5f));
  CHECK(load_environment(folder.name("grey.exr")).radiance[5] == glm::vec3(2.5f));
  write_image(folder.name("layer.exr"), 6, 4, 3, values, "zip", {"light.B", "light.G", "light.R"});
  CHECK(load_environment(folder.name("layer.exr")).radiance[5] == glm::vec3(values[17], values[16], values[15]));
  write_image(folder.name("part.exr"), 6, 4, 2, std::vector<float>(48, 1.0f), "zip", {"R", "G"});
  CHECK(user_error([&] { load_environment(folder.name("part.exr")); }) ==
        folder.name("part.exr") + ": cannot be read as an image: its channels are R, G; save it with R, G and B, or " +
            "one channel of grey");
}

TEST_CASE("a picture that is not twice as wide as high is said to be read as lat-long, also blended and turned") {
  TemporaryFolder folder;
  const auto with = [&](std::uint32_t width, std::uint32_t height) {
    write_image(folder.name("a.exr"), int(width), int(height), 3, std::vector<float>(width * height * 3, 1.0f));
    return load_environment(folder.name("a.exr"));
  };
  CHECK(with(6, 3).note == "");
  CHECK(with(1, 1).note == "");
  const Environment square = with(4, 4);
  CHECK(square.note == folder.name("a.exr") + ": 4 x 4, not twice as wide as high; read as lat-long all the same");
  const Environment constant = load_environment("constant");
  CHECK(blend_environments(square, constant, 0.5).note == square.note);
  CHECK(blend_environments(constant, square, 0.5).note == square.note);
  CHECK(rotate_environment(refine_environment(square, 64, 32), 10).note == square.note);
}

TEST_CASE("radiance that is NaN, infinite, negative or too large to be summed is refused by pixel, or clamped") {
  TemporaryFolder folder;
  const float nan = std::numeric_limits<float>::quiet_NaN(), inf = std::numeric_limits<float>::infinity();
  struct Case {
    float value;
    const char* word;
    float clamped;
  };
  for (const Case& bad : {Case{nan, "not a number", 0}, Case{inf, "infinite", 9}, Case{-inf, "negative", 0},
                          Case{-1, "negative", 0}, Case{3e38f, "above 1e30", 9}}) {
    std::vector<float> values(8 * 4 * 3, 1.0f);
    values[0] = 9;
    values[3 * (2 * 8 + 5) + 1] = bad.value;
    write_image(folder.name("bad.exr"), 8, 4, 3, values, "none");
    const std::string message = user_error([&] { load_environment(folder.name("bad.exr")); });
    INFO(message);
    CHECK(message.find("bad.exr") != std::string::npos);
    CHECK(message.find("(5, 2)") != std::string::npos);
    CHECK(message.find(bad.word) != std::string::npos);
    CHECK(message.find("--clamp-radiance") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
    CHECK(load_environment(folder.name("bad.exr"), true).radiance[2 * 8 + 5] == glm::vec3(1, bad.clamped, 1));
  }
}

TEST_CASE("truncated, damaged and missing environments are refused in one line that names the file") {
  TemporaryFolder folder;
  std::mt19937 random(4);
  std::vector<float> values(64 * 32 * 3);
  for (float& v : values) v = float(random() % 1000) * 0.01f;
  for (const char* compression : {"none", "zip", "piz", "rle"}) {
    write_image(folder.name("whole.exr"), 64, 32, 3, values, compression);
    const std::string whole = read_file(folder.name("whole.exr"));
    for (double part : {0.0, 0.01, 0.1, 0.5, 0.9, 0.999}) {
      const std::string file = folder.write("part.exr", whole.substr(0, std::size_t(double(whole.size()) * part)));
      const std::string message = user_error([&] { load_environment(file); });
      INFO(compression << " " << part << ": " << message);
      CHECK(message.find("part.exr") != std::string::npos);
      CHECK(message.find('\n') == std::string::npos);
    }
  }
  write_image(folder.name("whole.hdr"), 64, 32, 3, values);
  const std::string whole = read_file(folder.name("whole.hdr"));
  for (double part : {0.0, 0.005, 0.1, 0.5, 0.9, 0.999}) {
    const std::string file = folder.write("part.hdr", whole.substr(0, std::size_t(double(whole.size()) * part)));
    const std::string message = user_error([&] { load_environment(file); });
    INFO(part << ": " << message);
    CHECK(message.find("part.hdr") != std::string::npos);
    CHECK(message.find('\n') == std::string::npos);
  }
  CHECK(user_error([&] { load_environment(folder.name("none.hdr")); }).find("none.hdr") != std::string::npos);
  CHECK(user_error([&] { load_environment(folder.write("text.exr", "hello")); }).find("text.exr") != std::string::npos);
  CHECK(user_error([&] { load_environment(folder.name("picture.png")); }).find(".hdr or .exr") != std::string::npos);
  CHECK(user_error([] { load_environment("skiy"); }) == "unknown environment 'skiy'; did you mean 'sky'?");
}
