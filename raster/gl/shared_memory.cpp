#include "raster/gl/shared_memory.h"

#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace twinshade::gl {
namespace {

[[noreturn]] void fail(const char* what) { throw std::system_error(errno, std::generic_category(), what); }

std::byte* map_all(int fd, std::size_t size) {
  void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED, fd, 0);
  if (memory == MAP_FAILED) fail("cannot map shared memory");
  return static_cast<std::byte*>(memory);
}

}  // namespace

FileDescriptor::~FileDescriptor() {
  if (fd_ >= 0) close(fd_);
}

SharedMemory SharedMemory::create(std::size_t size) {
  SharedMemory memory;
  memory.fd_ = FileDescriptor(memfd_create("twinshade", MFD_CLOEXEC));
  if (memory.fd() < 0) fail("cannot make shared memory");
  if (ftruncate(memory.fd(), off_t(size)) != 0) fail("cannot size shared memory");
  memory.data_ = map_all(memory.fd(), size);
  memory.size_ = size;
  return memory;
}

SharedMemory SharedMemory::map(FileDescriptor fd) {
  SharedMemory memory;
  memory.fd_ = std::move(fd);
  struct stat status {};
  if (fstat(memory.fd(), &status) != 0) fail("cannot examine shared memory");
  memory.size_ = std::size_t(status.st_size);
  memory.data_ = map_all(memory.fd(), memory.size_);
  return memory;
}

SharedMemory::~SharedMemory() {
  if (data_ != nullptr) munmap(data_, size_);
}

}  // namespace twinshade::gl
