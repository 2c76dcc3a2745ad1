#include "raster/gl/channel.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>

namespace twinshade::gl {
namespace {

bool worth_retrying() { return errno == EAGAIN || errno == EINTR; }

}  // namespace

Channel::Channel(FileDescriptor socket) : socket_(std::move(socket)) {
  fcntl(socket_.get(), F_SETFL, fcntl(socket_.get(), F_GETFL) | O_NONBLOCK);
}

ChannelState Channel::wait(short events, std::optional<Clock::time_point> deadline) {
  for (;;) {
    int milliseconds = -1;
    if (deadline) {
      const auto left = std::chrono::ceil<std::chrono::milliseconds>(*deadline - Clock::now()).count();
      if (left <= 0) return ChannelState::timed_out;
      milliseconds = int(std::min<std::int64_t>(left, 1 << 30));
    }
    pollfd waited{socket_.get(), events, 0};
    const int ready = poll(&waited, 1, milliseconds);
    if (ready > 0) return ChannelState::ok;
    if (ready < 0 && !worth_retrying()) return ChannelState::closed;
  }
}

ChannelState Channel::send_bytes(const char* bytes, std::size_t count, std::optional<Clock::time_point> deadline) {
  while (count > 0) {
    const ssize_t sent = ::send(socket_.get(), bytes, count, MSG_NOSIGNAL);
    if (sent > 0) {
      bytes += sent;
      count -= std::size_t(sent);
      continue;
    }
    if (!worth_retrying()) return ChannelState::closed;
    if (const ChannelState state = wait(POLLOUT, deadline); state != ChannelState::ok) return state;
  }
  return ChannelState::ok;
}

ChannelState Channel::receive_bytes(char* bytes, std::size_t count, std::optional<Clock::time_point> deadline) {
  while (count > 0) {
    const ssize_t got = recv(socket_.get(), bytes, count, 0);
    if (got > 0) {
      bytes += got;
      count -= std::size_t(got);
      continue;
    }
    if (got == 0 || !worth_retrying()) return ChannelState::closed;
    if (const ChannelState state = wait(POLLIN, deadline); state != ChannelState::ok) return state;
  }
  return ChannelState::ok;
}

// A header of one length, which carries the descriptors, then the bytes.
ChannelState Channel::send(const std::string& bytes, const std::vector<int>& descriptors,
                           std::optional<Clock::time_point> deadline) {
  std::uint64_t length = bytes.size();
  iovec part{&length, sizeof length};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int) * kMostDescriptors)] = {};
  msghdr header{};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  if (!descriptors.empty()) {
    header.msg_control = control;
    header.msg_controllen = CMSG_SPACE(sizeof(int) * descriptors.size());
    cmsghdr* rights = CMSG_FIRSTHDR(&header);
    rights->cmsg_level = SOL_SOCKET;
    rights->cmsg_type = SCM_RIGHTS;
    rights->cmsg_len = CMSG_LEN(sizeof(int) * descriptors.size());
    std::memcpy(CMSG_DATA(rights), descriptors.data(), sizeof(int) * descriptors.size());
  }
  for (;;) {
    const ssize_t sent = sendmsg(socket_.get(), &header, MSG_NOSIGNAL);
    if (sent > 0) {
      const auto rest = std::size_t(sent);
      const auto state = send_bytes(reinterpret_cast<const char*>(&length) + rest, sizeof length - rest, deadline);
      return state == ChannelState::ok ? send_bytes(bytes.data(), bytes.size(), deadline) : state;
    }
    if (!worth_retrying()) return ChannelState::closed;
    if (const ChannelState state = wait(POLLOUT, deadline); state != ChannelState::ok) return state;
  }
}

ChannelState Channel::receive(Message& message, std::optional<Clock::time_point> deadline) {
  std::uint64_t length = 0;
  iovec part{&length, sizeof length};
  alignas(cmsghdr) char control[CMSG_SPACE(sizeof(int) * kMostDescriptors)] = {};
  msghdr header{};
  header.msg_iov = &part;
  header.msg_iovlen = 1;
  header.msg_control = control;
  header.msg_controllen = sizeof control;
  ssize_t got = 0;
  for (;;) {
    got = recvmsg(socket_.get(), &header, MSG_CMSG_CLOEXEC);
    if (got > 0) break;
    if (got == 0 || !worth_retrying()) return ChannelState::closed;
    if (const ChannelState state = wait(POLLIN, deadline); state != ChannelState::ok) return state;
  }
  message.descriptors.clear();
  for (cmsghdr* rights = CMSG_FIRSTHDR(&header); rights != nullptr; rights = CMSG_NXTHDR(&header, rights)) {
    if (rights->cmsg_type != SCM_RIGHTS) continue;
    const std::size_t count = (rights->cmsg_len - CMSG_LEN(0)) / sizeof(int);
    for (std::size_t i = 0; i < count; ++i) {
      int fd = -1;
      std::memcpy(&fd, CMSG_DATA(rights) + i * sizeof(int), sizeof fd);
      message.descriptors.emplace_back(fd);
    }
  }
  const auto rest = std::size_t(got);
  ChannelState state = receive_bytes(reinterpret_cast<char*>(&length) + rest, sizeof length - rest, deadline);
  if (state != ChannelState::ok) return state;
  message.bytes.resize(length);
  return receive_bytes(message.bytes.data(), length, deadline);
}

}  // namespace twinshade::gl
