#include "golden/pictures.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>

#include "base/error.h"
#include "base/parallel.h"
#include "base/portable_math.h"
#include "golden/compare_frames.h"
#include "images/image_file.h"

namespace twinshade {
namespace {

double tone_curve(double x, Tonemap tonemap) {
  switch (tonemap) {
    case Tonemap::none:
      return x;
    case Tonemap::reinhard:
      return x / (1 + x);
    case Tonemap::aces:
      return (x * (2.51 * x + 0.03)) / (x * (2.43 * x + 0.59) + 0.14);
  }
  return x;
}

double srgb_encoded(double linear) {
  if (linear <= 0.0031308) return 12.92 * linear;
  return 1.055 * portable::pow(linear, 1 / 2.4) - 0.055;
}

// The same to the nearest of 256, without a power for each value.
class Srgb8 {
 public:
  Srgb8() {
    for (std::size_t k = 1; k < 256; ++k) {  // bits of positive numbers are in the numbers' order
      auto below = std::bit_cast<std::uint64_t>(first_[k - 1]), at = std::bit_cast<std::uint64_t>(1.0);
      while (at - below > 1) {
        const std::uint64_t middle = below + (at - below) / 2;
        (std::floor(srgb_encoded(std::bit_cast<double>(middle)) * 255 + 0.5) >= double(k) ? at : below) = middle;
      }
      first_[k] = std::bit_cast<double>(at);
    }
    for (std::size_t cell = 0, k = 0; cell <= kCells; ++cell) {
      while (k < 255 && first_[k + 1] <= double(cell) / kCells) ++k;
      cell_[cell] = static_cast<unsigned char>(k);
    }
  }

  // linear: in [0, 1]
  unsigned char operator()(double linear) const {
    std::size_t k = cell_[std::size_t(linear * kCells)];
    while (k < 255 && first_[k + 1] <= linear) ++k;
    return static_cast<unsigned char>(k);
  }

 private:
  static constexpr std::size_t kCells = 4096;  // narrower than the steps of the darkest values, 1 / (12.92 * 255)
  std::array<double, 256> first_{};            // the least value that becomes each
  std::array<unsigned char, kCells + 1> cell_;
};

unsigned char toned_value(double exposed, Tonemap tonemap) {
  static const Srgb8 encoded;
  if (!(exposed > 0)) return 0;
  // Far above what is white in every curve, and before the curves' squares overflow
  return encoded(std::min(tone_curve(std::min(exposed, 1e100), tonemap), 1.0));
}

// An integer as it is, as far as a byte holds it. value: its bits.
unsigned char byte_of(Scalar scalar, float value) {
  const auto bits = std::bit_cast<std::uint32_t>(value);
  if (scalar == Scalar::i32 && std::bit_cast<std::int32_t>(bits) < 0) return 0;
  return static_cast<unsigned char>(std::min(bits, 255u));
}

// Integers are no radiance: words of their own type, as tools read them.
void write_integers(const std::string& path, const Frame& frame, const PictureOptions& options) {
  ChannelImage image;
  image.width = frame.width, image.height = frame.height;
  for (const char* channel : {"R", "G", "B", "A"}) image.channels.push_back({channel, false});
  image.words.reserve(frame.color.size());
  const std::size_t row = std::size_t(frame.width) * 4;
  for (std::size_t y = frame.height; y-- > 0;)
    for (std::size_t i = y * row; i < (y + 1) * row; ++i)
      image.words.push_back(std::bit_cast<std::uint32_t>(frame.color[i]));
  image.notes = options.notes;
  write_channel_file(path, image);
}

// A y-down picture whose rows are those of a y-up buffer, last row first.
template <class Rows>
ImageToWrite image_of(const Frame& frame, int channels, const Rows& y_up, const PictureOptions& options) {
  using T = typename Rows::value_type;
  const std::size_t row = std::size_t(frame.width) * channels;
  return {frame.width,
          frame.height,
          channels,
          sizeof(T) == 4,
          y_up.data() + (frame.height - 1) * row,
          -std::ptrdiff_t(row * sizeof(T)),
          options.notes};
}

using Rgb = std::array<unsigned char, 3>;

Rgb mixed(const Rgb& a, const Rgb& b, double t) {
  Rgb result;
  for (int c = 0; c < 3; ++c) result[c] = static_cast<unsigned char>(std::lround(a[c] + (b[c] - a[c]) * t));
  return result;
}

// Blue at 1 ULP, red at 2^16, two octaves of colour between; by the distance's bit length.
Rgb heat(std::uint64_t ulp) {
  if (ulp == UINT64_MAX) return {255, 255, 255};
  constexpr std::array<Rgb, 4> kRamp{{{60, 90, 255}, {40, 200, 80}, {250, 220, 40}, {255, 30, 20}}};
  int octaves = 0;
  while (octaves < 16 && (ulp >> (octaves + 1)) != 0) ++octaves;
  const double place = octaves / 16.0 * 3;
  const int segment = std::min(int(place), 2);
  return mixed(kRamp[segment], kRamp[segment + 1], place - segment);
}

Rgb difference_color(const Frame& a, const Frame& b, std::size_t pixel) {
  if (a.coverage[pixel] != b.coverage[pixel]) return {255, 0, 255};
  if (a.primitive_id[pixel] != b.primitive_id[pixel]) return {255, 140, 0};
  const float* color_a = &a.color[pixel * 4];
  const float* color_b = &b.color[pixel * 4];
  std::uint64_t worst = 0;
  for (int c = 0; c < 4; ++c)  // zeros of different sign are 0 ULP apart and yet differ
    if (!same_value(a.color_scalar, color_a[c], color_b[c]))
      worst = std::max({worst, std::uint64_t{1}, value_distance(a.color_scalar, color_a[c], color_b[c])});
  if (worst > 0) return heat(worst);
  if (!same_value(Scalar::f32, a.depth[pixel], b.depth[pixel])) return {0, 220, 220};
  const std::size_t pixels = std::size_t(a.width) * a.height;
  if (a.coverage[pixel] && a.attribute_names == b.attribute_names)
    for (std::size_t c = 0; c < a.attribute_names.size(); ++c)
      if (!same_value(a.attribute_scalars[c], a.attributes[c * pixels + pixel], b.attributes[c * pixels + pixel]))
        return {0, 220, 220};
  if (a.color_scalar != Scalar::f32) {
    Rgb dim;
    for (int c = 0; c < 3; ++c) dim[c] = byte_of(a.color_scalar, color_a[c]) / 3;
    return dim;
  }
  const double luminance = 0.2126 * color_a[0] + 0.7152 * color_a[1] + 0.0722 * color_a[2];
  const auto grey = static_cast<unsigned char>(display_value(luminance, 0, Tonemap::reinhard) / 3);
  return {grey, grey, grey};
}

// RGB of a picture for people.
std::vector<unsigned char> displayed(const Frame& frame, const PictureOptions& options) {
  std::vector<unsigned char> rgb(std::size_t(frame.width) * frame.height * 3);
  const double scale = portable::exp2(options.exposure);
  parallel_for(frame.height, [&](std::size_t y, int) {
    for (std::size_t i = y * frame.width; i < (y + 1) * frame.width; ++i)
      for (std::size_t c = 0; c < 3; ++c)
        rgb[i * 3 + c] = frame.color_scalar != Scalar::f32
                             ? byte_of(frame.color_scalar, frame.color[i * 4 + c])
                             : toned_value(double(frame.color[i * 4 + c]) * scale, options.tonemap);
  });
  return rgb;
}

std::vector<unsigned char> difference_colors(const Frame& a, const Frame& b) {
  TWINSHADE_CHECK_EQ(a.width, b.width);
  TWINSHADE_CHECK_EQ(a.height, b.height);
  std::vector<unsigned char> rgb(std::size_t(a.width) * a.height * 3);
  parallel_for(a.height, [&](std::size_t y, int) {
    for (std::size_t i = y * a.width; i < (y + 1) * a.width; ++i) {
      const Rgb color = difference_color(a, b, i);
      std::copy(color.begin(), color.end(), rgb.begin() + std::ptrdiff_t(i * 3));
    }
  });
  return rgb;
}

}  // namespace

unsigned char display_value(double radiance, double exposure, Tonemap tonemap) {
  return toned_value(exposure == 0 ? radiance : radiance * portable::exp2(exposure), tonemap);
}

void require_picture_ending(const std::string& path) {
  const std::string ending = lower_case_ending(path);
  if (ending != ".exr" && ending != ".hdr" && ending != ".png")
    throw UserError(path + ": unknown kind of picture; end the name in .exr, .hdr or .png");
}

void write_picture(const std::string& path, const Frame& frame, const PictureOptions& options) {
  require_picture_ending(path);
  TWINSHADE_CHECK_EQ(frame.color.size(), std::size_t(frame.width) * frame.height * 4);
  const std::string ending = lower_case_ending(path);
  const std::size_t pixels = std::size_t(frame.width) * frame.height;
  const bool integers = frame.color_scalar != Scalar::f32;
  if (ending == ".exr" && integers) {
    write_integers(path, frame, options);
  } else if (ending == ".exr") {
    write_image_file(path, image_of(frame, 4, frame.color, options));
  } else if (ending == ".hdr") {
    if (integers)
      throw UserError(path +
                      ": the shader's output is of integers, which are no radiance; name an .exr, which keeps "
                      "them, or a .png, which shows 0 to 255");
    std::vector<float> rgb(pixels * 3);
    for (std::size_t i = 0; i < pixels; ++i)
      for (std::size_t c = 0; c < 3; ++c) {
        const float v = frame.color[i * 4 + c];
        rgb[i * 3 + c] = v > 0 ? v : 0.0f;
      }
    write_image_file(path, image_of(frame, 3, rgb, options));
  } else {
    write_image_file(path, image_of(frame, 3, displayed(frame, options), options));
  }
}

void write_difference_picture(const std::string& path, const Frame& a, const Frame& b) {
  if (lower_case_ending(path) != ".png") throw UserError(path + ": a picture of differences must end in .png");
  write_image_file(path, image_of(a, 3, difference_colors(a, b), {}));
}

std::string picture_png(const Frame& frame, const PictureOptions& options) {
  TWINSHADE_CHECK_EQ(frame.color.size(), std::size_t(frame.width) * frame.height * 4);
  return encode_png(image_of(frame, 3, displayed(frame, options), options));
}

std::string difference_png(const Frame& a, const Frame& b) {
  return encode_png(image_of(a, 3, difference_colors(a, b), {}));
}

}  // namespace twinshade
