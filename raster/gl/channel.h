// Messages of any length, with file descriptors, over a Unix stream socket.
#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <vector>

#include "raster/gl/shared_memory.h"

namespace twinshade::gl {

struct Message {
  std::string bytes;
  std::vector<FileDescriptor> descriptors;  // at most kMostDescriptors
};

inline constexpr int kMostDescriptors = 4;

enum class ChannelState { ok, closed, timed_out };

class Channel {
 public:
  using Clock = std::chrono::steady_clock;
  explicit Channel(FileDescriptor socket);
  // Both give up at `deadline`; nullopt: wait for ever.
  ChannelState send(const std::string& bytes, const std::vector<int>& descriptors,
                    std::optional<Clock::time_point> deadline);
  ChannelState receive(Message& message, std::optional<Clock::time_point> deadline);

 private:
  ChannelState wait(short events, std::optional<Clock::time_point> deadline);
  ChannelState send_bytes(const char* bytes, std::size_t count, std::optional<Clock::time_point> deadline);
  ChannelState receive_bytes(char* bytes, std::size_t count, std::optional<Clock::time_point> deadline);
  FileDescriptor socket_;
};

}  // namespace twinshade::gl
