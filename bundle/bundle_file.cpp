// The bundle as bytes: "TWSBNDL" + version, then each field in the order of struct Bundle, little-endian, lengths as
// u64; the SHA-256 of all before it, as 64 hex digits, ends the file.
#include <bit>
#include <cstring>
#include <fstream>
#include <type_traits>

#include "base/error.h"
#include "base/file.h"
#include "base/hash.h"
#include "bundle/bundle.h"

namespace twinshade {
namespace {

static_assert(std::endian::native == std::endian::little, "the bundle is written in memory order");

constexpr std::string_view kMagic = "TWSBNDL2";
constexpr std::size_t kHashLength = 64;

class Writer {
 public:
  std::string bytes;

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void operator()(const T& value) { bytes.append(reinterpret_cast<const char*>(&value), sizeof value); }
  void operator()(const std::string& text) {
    length(text.size());
    bytes += text;
  }
  template <class T>
  void operator()(const std::vector<T>& list) {
    length(list.size());
    if constexpr (std::is_trivially_copyable_v<T>)
      bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(T));
    else
      for (const T& item : list) visit(*this, item);
  }

 private:
  void length(std::uint64_t count) { (*this)(count); }
};

class Reader {
 public:
  Reader(std::string_view bytes, const std::string& origin) : rest_(bytes), origin_(origin) {}

  template <class T>
  requires std::is_arithmetic_v<T> || std::is_enum_v<T>
  void operator()(T& value) { copy(&value, sizeof value); }
  void operator()(bool& value) {
    std::uint8_t byte = 0;
    copy(&byte, 1);
    if (byte > 1) throw UserError(origin_ + ": damaged bundle: a truth value is " + std::to_string(byte));
    value = byte == 1;
  }
  void operator()(std::string& text) {
    text.resize(length(1));
    copy(text.data(), text.size());
  }
  template <class T>
  void operator()(std::vector<T>& list) {
    if constexpr (std::is_trivially_copyable_v<T>) {
      list.resize(length(sizeof(T)));
      copy(list.data(), list.size() * sizeof(T));
    } else {
      // One by one: a damaged count of what takes many times the bytes that it is read from ends where those do.
      list.clear();
      for (std::size_t rest = length(1); rest > 0; --rest) visit(*this, list.emplace_back());
    }
  }
  bool at_end() const { return rest_.empty(); }

 private:
  // Lengths are checked against what is left before anything is allocated.
  std::size_t length(std::size_t item_size) {
    std::uint64_t count = 0;
    (*this)(count);
    if (count > rest_.size() / item_size) throw UserError(origin_ + ": damaged bundle: a length runs past its end");
    return std::size_t(count);
  }
  void copy(void* to, std::size_t count) {
    if (count > rest_.size()) throw UserError(origin_ + ": damaged bundle: it ends too early");
    if (count != 0) std::memcpy(to, rest_.data(), count);
    rest_.remove_prefix(count);
  }
  std::string_view rest_;
  const std::string& origin_;
};

// One list of fields for both directions.
template <class IO, class T>
void visit(IO& io, T& item) {
  using Item = std::remove_const_t<T>;
  if constexpr (std::is_same_v<Item, Attribute>) {
    io(item.name), io(item.scalar), io(item.components), io(item.values);
  } else if constexpr (std::is_same_v<Item, Texture>) {
    io(item.name), io(item.kind), io(item.width), io(item.height), io(item.layers), io(item.filter), io(item.wrap);
    io(item.texels);
  } else if constexpr (std::is_same_v<Item, Uniform>) {
    io(item.name), io(item.scalar), io(item.columns), io(item.rows), io(item.array_length), io(item.values);
  } else if constexpr (std::is_same_v<Item, Buffer>) {
    io(item.name), io(item.storage), io(item.bytes);
  } else if constexpr (std::is_same_v<Item, std::pair<std::string, std::string>>) {
    io(item.first), io(item.second);
  } else {
    static_assert(std::is_same_v<Item, Bundle>);
    io(item.width), io(item.height), io(item.clip_positions), io(item.indices), io(item.cull_back_faces);
    io(item.attributes), io(item.textures), io(item.uniforms), io(item.buffers), io(item.notes);
  }
}

}  // namespace

std::string serialize(const Bundle& bundle) {
  Writer writer;
  writer.bytes = kMagic;
  visit(writer, bundle);
  writer.bytes += sha256_hex(writer.bytes);
  return std::move(writer.bytes);
}

bool looks_like_bundle(std::string_view first_bytes) { return first_bytes.substr(0, 7) == kMagic.substr(0, 7); }

Bundle deserialize(std::string_view bytes, const std::string& origin) {
  if (!looks_like_bundle(bytes)) throw UserError(origin + ": is not a bundle; make one with `twinshade bake`");
  if (bytes.substr(0, kMagic.size()) != kMagic)
    throw UserError(origin + ": was written by another version of twinshade; bake it again");
  if (bytes.size() < kMagic.size() + kHashLength) throw UserError(origin + ": damaged bundle: it ends too early");
  const std::string_view content = bytes.substr(0, bytes.size() - kHashLength);
  if (sha256_hex(content) != bytes.substr(content.size()))
    throw UserError(origin + ": damaged bundle: its hash does not match its content; bake it again");
  Reader reader(content.substr(kMagic.size()), origin);
  Bundle bundle;
  visit(reader, bundle);
  if (!reader.at_end()) throw UserError(origin + ": damaged bundle: bytes left over at its end");
  validate(bundle, origin);
  return bundle;
}

void write_bundle(const std::string& path, const Bundle& bundle) { write_file(path, serialize(bundle)); }

Bundle read_bundle(const std::string& path) { return deserialize(read_file(path), path); }

std::string bundle_hash(const Bundle& bundle) {
  const std::string bytes = serialize(bundle);
  return bytes.substr(bytes.size() - kHashLength);
}

}  // namespace twinshade
