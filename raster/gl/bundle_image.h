// The big parts of a bundle laid out in shared memory, kept by both sides until the bundle changes.
#pragma once

#include "raster/gl/protocol.h"
#include "raster/gl/shared_memory.h"

namespace twinshade::gl {

class BundleImage {
 public:
  // True if the image was made anew: the worker has to be sent fd() and index(). Whether the bundle is still the same
  // is decided by comparing its content, which costs a fraction of hashing it.
  bool update(const Bundle& bundle);
  void forget() { *this = BundleImage(); }
  int fd() const { return memory_.fd(); }
  const ImageIndex& index() const { return index_; }

 private:
  SharedMemory memory_;
  ImageIndex index_;
  std::string index_bytes_;
};

}  // namespace twinshade::gl
