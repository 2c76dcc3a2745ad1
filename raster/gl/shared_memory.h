// Memory that two processes see: an anonymous file (memfd), mapped.
#pragma once

#include <cstddef>
#include <utility>

namespace twinshade::gl {

class FileDescriptor {
 public:
  explicit FileDescriptor(int fd = -1) : fd_(fd) {}
  FileDescriptor(FileDescriptor&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}
  FileDescriptor& operator=(FileDescriptor&& other) noexcept {
    std::swap(fd_, other.fd_);
    return *this;
  }
  ~FileDescriptor();
  int get() const { return fd_; }
  void reset() { *this = FileDescriptor(); }

 private:
  int fd_;
};

class SharedMemory {
 public:
  SharedMemory() = default;
  // std::system_error if the system has no memory for it. New memory is zero.
  static SharedMemory create(std::size_t size);
  static SharedMemory map(FileDescriptor fd);  // all of it

  SharedMemory(SharedMemory&& other) noexcept { swap(other); }
  SharedMemory& operator=(SharedMemory&& other) noexcept {
    swap(other);
    return *this;
  }
  ~SharedMemory();

  int fd() const { return fd_.get(); }
  std::byte* data() const { return data_; }
  std::size_t size() const { return size_; }

 private:
  void swap(SharedMemory& other) {
    std::swap(fd_, other.fd_);
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  FileDescriptor fd_;
  std::byte* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace twinshade::gl
