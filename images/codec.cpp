// The module of images/image_codec.h: OpenImageIO.
#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>
#include <fcntl.h>
#include <sys/mman.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iterator>
#include <memory>
#include <new>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <string_view>
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

using Names = std::vector<std::string>;

std::string lower_case(std::string text) {
  for (char& c : text) c = c >= 'A' && c <= 'Z' ? char(c - 'A' + 'a') : c;
  return text;
}

// The channel of that name, in either case; -1: there is none.
int channel_named(const Names& names, const std::string& wanted) {
  for (std::size_t c = 0; c < names.size(); ++c)
    if (lower_case(names[c]) == lower_case(wanted)) return int(c);
  return -1;
}

// Red, green, blue and, where it is there, alpha of a layer, whose name ends in a point; of "", the picture itself.
// Empty where one of the three is missing.
std::vector<int> colours_of(const Names& names, const std::string& layer) {
  std::vector<int> channels;
  for (const char* channel : {"R", "G", "B"}) channels.push_back(channel_named(names, layer + channel));
  if (std::find(channels.begin(), channels.end(), -1) != channels.end()) return {};
  if (const int alpha = channel_named(names, layer + "A"); alpha >= 0) channels.push_back(alpha);
  return channels;
}

// Layers with red, green and blue, in the order of their channels.
Names layers_of_colour(const Names& names) {
  Names layers;
  for (const std::string& name : names) {
    const std::string layer = name.substr(0, name.rfind('.') + 1);
    if (!layer.empty() && std::find(layers.begin(), layers.end(), layer) == layers.end() &&
        !colours_of(names, layer).empty())
      layers.push_back(layer);
  }
  return layers;
}

// Whether a channel is no light: depth, or what a pixel covers. Layers say so by their names, too.
bool is_depth_or_alpha(const std::string& name) {
  constexpr const char* kWords[] = {"z", "zback", "depth", "a", "alpha"};
  std::istringstream parts(lower_case(name));
  for (std::string part; std::getline(parts, part, '.');)
    if (std::find(std::begin(kWords), std::end(kWords), part) != std::end(kWords)) return true;
  return false;
}

std::string listed(const Names& names) {
  constexpr std::size_t kMost = 12;
  std::string text;
  for (std::size_t i = 0; i < std::min(names.size(), kMost); ++i) text += (i > 0 ? ", " : "") + names[i];
  return names.size() > kMost ? text + " and " + std::to_string(names.size() - kMost) + " more" : text;
}

// The channels that make the picture, by their names: R, G, B and A; else, of an EXR file, those of the only layer that
// has them, or one of grey, and A. Other formats do not name their channels: the first ones in their order.
std::vector<int> channels_read(const Names& names, bool is_exr) {
  if (const std::vector<int> colours = colours_of(names, ""); !colours.empty()) return colours;
  if (!is_exr) {
    std::vector<int> first(std::min<std::size_t>(names.size(), 4));
    std::iota(first.begin(), first.end(), 0);
    return first;
  }
  Names layers = layers_of_colour(names);
  if (layers.size() == 1) return colours_of(names, layers.front());
  if (!layers.empty()) {
    for (std::string& layer : layers) layer.pop_back();
    refuse("it has R, G and B in the layers " + listed(layers) + "; save the one that is meant alone");
  }
  const int alpha = channel_named(names, "A");
  int grey = channel_named(names, "Y");
  if (channel_named(names, "RY") >= 0 || channel_named(names, "BY") >= 0) grey = -1;  // a part of a colour
  if (grey < 0 && names.size() == (alpha >= 0 ? 2u : 1u)) grey = alpha == 0 ? int(names.size()) - 1 : 0;
  if (grey < 0 || is_depth_or_alpha(names[std::size_t(grey)]))
    refuse("its channels are " + listed(names) + "; save it with R, G and B, or one channel of grey");
  return alpha >= 0 ? std::vector<int>{grey, alpha} : std::vector<int>{grey};
}

// Of a size that can be, and stored as it is seen.
void require_plain(const OIIO::ImageSpec& spec) {
  if (spec.width < 1 || spec.height < 1 || spec.width > kLargestSide || spec.height > kLargestSide || spec.depth > 1 ||
      double(spec.width) * spec.height * spec.nchannels > kMostSamples)
    refuse("its size is " + std::to_string(spec.width) + " x " + std::to_string(spec.height));
  if (spec.deep) refuse("deep images are not supported");
  if (spec.x != spec.full_x || spec.y != spec.full_y || spec.width != spec.full_width ||
      spec.height != spec.full_height)
    refuse("its data window is not its display window; crop or fill it first");
}

// What an OpenEXR file of several parts, as of two eyes, has beside the first. Empty where there is nothing.
std::string unread_parts(OIIO::ImageInput& input) {
  if (std::string_view(input.format_name()) != "openexr") return "";
  Names parts;
  for (int part = 0; input.seek_subimage(part, 0); ++part) {
    const std::string name(input.spec().get_string_attribute("oiio:subimagename"));
    parts.push_back(name.empty() ? "part " + std::to_string(part + 1) : name);
  }
  if (parts.size() < 2) return "";
  return "of its " + std::to_string(parts.size()) + " parts the first alone is read, " + parts.front() + ", not " +
         listed({parts.begin() + 1, parts.end()});
}

DecodedImage read_all(OIIO::ImageInput& input, std::uint64_t most) {
  const OIIO::ImageSpec spec = input.spec();
  require_plain(spec);
  if (spec.get_int_attribute("Orientation", 1) != 1) refuse("it is stored turned or mirrored; save it upright");

  const std::vector<int> order = channels_read(spec.channelnames, std::string_view(input.format_name()) == "openexr");
  for (const int channel : order)
    if (spec.channelformat(channel).basetype == OIIO::TypeDesc::UINT32)
      refuse("its channels are whole numbers of 32 bits, which have no largest one to divide by; save it as floats");
  DecodedImage image;
  image.width = std::uint32_t(spec.width);
  image.height = std::uint32_t(spec.height);
  image.channels = std::uint32_t(order.size());
  image.bits = spec.format == OIIO::TypeDesc::UINT8 ? 8 : spec.format == OIIO::TypeDesc::UINT16 ? 16 : 32;
  const std::size_t pixels = std::size_t(image.width) * image.height;
  const auto pick = [&](const auto* raw, double largest) {
    for (std::size_t p = 0; p < pixels; ++p)
      for (std::uint32_t c = 0; c < image.channels; ++c)
        image.texels[p * image.channels + c] =
            float(double(raw[p * std::size_t(spec.nchannels) + std::size_t(order[c])]) / largest);
  };
  const auto read = [&](auto type, OIIO::TypeDesc format, double largest) {
    const std::size_t samples = pixels * std::size_t(spec.nchannels);
    if (samples * sizeof type + pixels * image.channels * sizeof(float) > most) throw std::bad_alloc();
    // Zeros of which the system makes pages where something is written: a few bytes may claim any size.
    using Sample = decltype(type);
    const std::unique_ptr<Sample, decltype(&std::free)> raw(static_cast<Sample*>(std::calloc(samples, sizeof(Sample))),
                                                            &std::free);
    if (!raw) throw std::bad_alloc();
    if (!input.read_image(0, 0, 0, spec.nchannels, format, raw.get())) refuse(input.geterror());
    if (input.has_error()) refuse(input.geterror());
    image.texels.resize(pixels * image.channels);
    pick(raw.get(), largest);
  };
  if (image.bits == 8)
    read(std::uint8_t{}, OIIO::TypeDesc::UINT8, 255);
  else if (image.bits == 16)
    read(std::uint16_t{}, OIIO::TypeDesc::UINT16, 65535);
  else
    read(float{}, OIIO::TypeDesc::FLOAT, 1);
  image.note = unread_parts(input);
  return image;
}

// By its name: open() would try what else the library reads on a damaged file.
std::unique_ptr<OIIO::ImageInput> reader_of(const std::string& format) {
  std::unique_ptr<OIIO::ImageInput> input = OIIO::ImageInput::create(format);
  if (!input) refuse(OIIO::geterror());
  return input;
}

DecodedImage read_opened(OIIO::ImageInput& input, const std::string& name, std::uint64_t most) {
  OIIO::ImageSpec config, spec;
  config.attribute("oiio:UnassociatedAlpha", 1);
  if (!input.open(name, spec, config)) refuse(input.geterror());
  return read_all(input, most);
}

DecodedImage read_file(const std::string& path, const std::string& format, std::uint64_t most) {
  const StderrOfLibraries quiet;
  return read_opened(*reader_of(format), path, most);
}

DecodedImage read_memory(std::string_view bytes, const std::string& format, std::uint64_t most) {
  const StderrOfLibraries quiet;
  OIIO::Filesystem::IOMemReader reader(const_cast<char*>(bytes.data()), bytes.size());
  const std::unique_ptr<OIIO::ImageInput> input = reader_of(format);
  if (!input->supports("ioproxy") || !input->set_ioproxy(&reader))
    refuse("this format is read from files alone, not from a pipe");
  return read_opened(*input, "memory." + format, most);
}

constexpr std::string_view kNotePrefix = "twinshade:";

void add_notes(OIIO::ImageSpec& spec, const std::vector<std::pair<std::string, std::string>>& notes) {
  // The library would put the time of writing into EXR files.
  spec.attribute("DateTime", "1970:01:01 00:00:00");
  for (const auto& [key, value] : notes) spec.attribute(std::string(kNotePrefix) + key, value);
}

// Into memory first: writing to a file itself, the library does not see all that fails, and a PNG cut short would pass.
// The bytes of a file of that name.
std::string encoded_pixels(const std::string& name, const OIIO::ImageSpec& spec, OIIO::TypeDesc type,
                           const void* upper_row, OIIO::stride_t row_stride) {
  const auto out = OIIO::ImageOutput::create(name);
  if (!out) refuse(OIIO::geterror());
  OIIO::Filesystem::IOVecOutput memory;
  if (!out->supports("ioproxy") || !out->set_ioproxy(&memory)) refuse("this format cannot be made in memory");
  if (!out->open(name, spec)) refuse(out->geterror());
  if (!out->write_image(type, upper_row, OIIO::AutoStride, row_stride)) refuse(out->geterror());
  if (!out->close()) refuse(out->geterror());
  const auto& bytes = memory.buffer();
  return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

void write_bytes(const std::string& path, const std::string& bytes) {
  std::ofstream file(path, std::ios::binary);
  if (file) file.write(bytes.data(), std::streamsize(bytes.size()));
  file.close();
  if (!file) refuse(std::strerror(errno));
}

std::string encode(const std::string& name, const ImageToWrite& image) {
  const OIIO::TypeDesc type = image.is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT8;
  OIIO::ImageSpec spec(int(image.width), int(image.height), image.channels, type);
  if (image.is_float)
    spec.attribute("compression", "zip");
  else
    spec.attribute("oiio:ColorSpace", "sRGB");
  add_notes(spec, image.notes);
  return encoded_pixels(name, spec, type, image.upper_row, OIIO::stride_t(image.row_stride));
}

void write_file(const std::string& path, const ImageToWrite& image) { write_bytes(path, encode(path, image)); }

OIIO::TypeDesc word_type(bool is_float) { return is_float ? OIIO::TypeDesc::FLOAT : OIIO::TypeDesc::UINT32; }

void write_channels(const std::string& path, const ChannelImage& image) {
  OIIO::ImageSpec spec(int(image.width), int(image.height), int(image.channels.size()), OIIO::TypeDesc::FLOAT);
  spec.channelnames.clear();
  for (const ChannelImage::Channel& channel : image.channels) {
    spec.channelnames.push_back(channel.name);
    spec.channelformats.push_back(word_type(channel.is_float));
  }
  spec.attribute("compression", "zip");
  add_notes(spec, image.notes);
  // UNKNOWN: each channel is in its own format already.
  write_bytes(path, encoded_pixels(path, spec, OIIO::TypeDesc::UNKNOWN, image.words.data(), OIIO::AutoStride));
}

ChannelImage read_channels(const std::string& path, std::uint64_t most) {
  const StderrOfLibraries quiet;
  const std::unique_ptr<OIIO::ImageInput> input = reader_of("openexr");
  OIIO::ImageSpec spec;
  if (!input->open(path, spec)) refuse(input->geterror());
  require_plain(spec);
  ChannelImage image;
  image.width = std::uint32_t(spec.width);
  image.height = std::uint32_t(spec.height);
  for (int c = 0; c < spec.nchannels; ++c) {
    const OIIO::TypeDesc type = spec.channelformat(c);
    if (type != word_type(true) && type != word_type(false))
      refuse("its channel " + spec.channelnames[std::size_t(c)] + " is not of 32 bits");
    image.channels.push_back({spec.channelnames[std::size_t(c)], type == word_type(true)});
  }
  for (const OIIO::ParamValue& value : spec.extra_attribs)
    if (const std::string_view name(value.name().c_str()); name.substr(0, kNotePrefix.size()) == kNotePrefix)
      image.notes.emplace_back(name.substr(kNotePrefix.size()), value.get_string());
  const std::size_t count = std::size_t(image.width) * image.height * image.channels.size();
  if (count * sizeof(std::uint32_t) > most) throw std::bad_alloc();
  image.words.resize(count);
  if (!input->read_image(0, 0, 0, spec.nchannels, OIIO::TypeDesc::UNKNOWN, image.words.data()) || input->has_error())
    refuse(input->geterror());
  return image;
}

}  // namespace
}  // namespace twinshade

extern "C" __attribute__((visibility("default"))) const twinshade::ImageCodec twinshade_image_codec_5;
const twinshade::ImageCodec twinshade_image_codec_5 = {twinshade::read_file,     twinshade::read_memory,
                                                       twinshade::write_file,    twinshade::encode,
                                                       twinshade::read_channels, twinshade::write_channels};
