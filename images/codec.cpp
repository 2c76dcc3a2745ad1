// The module of images/image_codec.h: OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "base/sanitizers.h"
#include "images/image_codec.h"

namespace twinshade {
namespace {

constexpr int kLargestSide = 65536;
constexpr double kMostSamples = 0x1p30;  // 4 GiB as floats

[[noreturn]] void refuse(const std::string& reason) { throw std::runtime_error(reason); }

// libpng and its like write to stderr about damage, and OpenImageIO gives no way to ask them not to. Where the image is
// refused, that says what is wrong; else what they wrote follows. For one thread at a time, as images are read. Not
// where sanitizers report on stderr.
class StderrOfLibraries {
 public:
  StderrOfLibraries()
      : own_(kShadowMemory ? -1 : fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)),
        kept_(own_ >= 0 ? memfd_create("stderr", MFD_CLOEXEC) : -1) {
    if (kept_ >= 0 && own_ >= 0) dup2(kept_, STDERR_FILENO);
  }
  ~StderrOfLibraries() {
    if (kept_ >= 0 && own_ >= 0) {
      dup2(own_, STDERR_FILENO);
      if (std::uncaught_exceptions() == exceptions_) pass_on();
    }
    if (kept_ >= 0) close(kept_);
    if (own_ >= 0) close(own_);
  }
  StderrOfLibraries(const StderrOfLibraries&) = delete;
  StderrOfLibraries& operator=(const StderrOfLibraries&) = delete;

 private:
  void pass_on() const {
    char text[4096];
    off_t at = 0;
    for (ssize_t count; (count = pread(kept_, text, sizeof text, at)) > 0;) {
      const ssize_t written = write(STDERR_FILENO, text, std::size_t(count));
      if (written < 0 && errno != EINTR) return;
      at += std::max<ssize_t>(written, 0);
    }
  }

  int own_, kept_;  // the stderr that there was; the libraries' text
  int exceptions_ = std::uncaught_exceptions();
};

DecodedImage read_all(OIIO::ImageInput& input) {
  const OIIO::ImageSpec spec = input.spec();
  if (spec.width < 1 || spec.height < 1 || spec.width > kLargestSide || spec.height > kLargestSide || spec.depth > 1 ||
      double(spec.width) * spec.height * spec.nchannels > kMostSamples)
    refuse("its size is " + std::to_string(spec.width) + " x " + std::to_string(spec.height));
  if (spec.deep) refuse("deep images are not supported");
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height)
    refuse("its data window is not its display window; crop or fill it first");
  if (spec.get_int_attribute("Orientation", 1) != 1) refuse("it is stored turned or mirrored; save it upright");

  // R, G, B, A by name, else the first channels in their order.
  std::vector<int> order;
  for (const char* wanted : {"R", "G", "B", "A"})
    for (int c = 0; c < spec.nchannels; ++c)
      if (spec.channel_name(c) == wanted) order.push_back(c);
  const bool named = order.size() >= 3;
  DecodedImage image;
  image.width = std::uint32_t(spec.width);
  image.height = std::uint32_t(spec.height);
  image.channels = named ? std::uint32_t(order.size()) : std::uint32_t(std::min(spec.nchannels, 4));
  image.bits = spec.format == OIIO::TypeDesc::UINT8 ? 8 : spec.format == OIIO::TypeDesc::UINT16 ? 16 : 32;
  const std::size_t pixels = std::size_t(image.width) * image.height;
  image.texels.resize(pixels * image.channels);
  const auto pick = [&](const auto* raw, double largest) {
    for (std::size_t p = 0; p < pixels; ++p)
      for (std::uint32_t c = 0; c < image.channels; ++c) {
        const int from = named ? order[c] : int(c);
        image.texels[p * image.channels + c] =
            float(double(raw[p * std::size_t(spec.nchannels) + std::size_t(from)]) / largest);
      }
  };
  const auto read = [&](auto type, OIIO::TypeDesc format, double largest) {
    std::vector<decltype(type)> raw(pixels * std::size_t(spec.nchannels));
    if (!input.read_image(0, 0, 0, spec.nchannels, format, raw.data())) refuse(input.geterror());
    if (input.has_error()) refuse(input.geterror());
    pick(raw.data(), largest);
  };
  if (image.bits == 8)
    read(std::uint8_t{}, OIIO::TypeDesc::UINT8, 255);
  else if (image.bits == 16)
    read(std::uint16_t{}, OIIO::TypeDesc::UINT16, 65535);
  else
    read(float{}, OIIO::TypeDesc::FLOAT, 1);
  return image;
}

DecodedImage read_file(const std::string& path) {
  const StderrOfLibraries quiet;
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (path.find('?') != std::string::npos)
    refuse("the image library takes what follows a '?' in a name for options; rename it");
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(path, &config);
  if (!input) refuse(OIIO::geterror());
  return read_all(*input);
}

DecodedImage read_memory(std::string_view bytes, bool png) {
  const StderrOfLibraries quiet;
  OIIO::Filesystem::IOMemReader reader(const_cast<char*>(bytes.data()), bytes.size());
  OIIO::Filesystem::IOProxy* proxy = &reader;
  OIIO::ImageSpec config;
  config.attribute("oiio:UnassociatedAlpha", 1);
  config.attribute("oiio:ioproxy", OIIO::TypeDesc::PTR, &proxy);
  const std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::open(png ? "memory.png" : "memory.jpg", &config);
  if (!input) refuse(OIIO::geterror());
  return read_all(*input);
}

void write_file(const std::string& path, const ImageToWrite& image) {
  const auto out = OIIO::ImageOutput::create(path);
  if (!out) refuse(OIIO::geterror());
  const OIIO::TypeDesc type = image.is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
  OIIO::ImageSpec spec(int(image.width), int(image.height), image.channels, type);
  if (image.is_float)
    spec.attribute("compression", "zip");
  else
    spec.attribute("oiio:ColorSpace", "sRGB");
  // The library would put the time of writing into EXR files.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  for (const auto& [key, value] : image.notes) spec.attribute("twinshade:" + key, value);
  if (!out->open(path, spec)) refuse(out->geterror());
  if (!out->write_image(type, image.upper_row, OIIO::AutoStride, OIIO::stride_t(image.row_stride)))
    refuse(out->geterror());
  if (!out->close()) refuse(out->geterror());
}

}  // namespace
}  // namespace twinshade

extern "C" __attribute__((visibility("default"))) const twinshade::ImageCodec twinshade_image_codec;
const twinshade::ImageCodec twinshade_image_codec = {twinshade::read_file, twinshade::read_memory,
                                                     twinshade::write_file};
