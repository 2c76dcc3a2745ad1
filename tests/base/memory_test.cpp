#include "base/memory.h"

#include <doctest/doctest.h>
#include <sys/resource.h>

#include <string>
#include <vector>

#include "base/error.h"
#include "base/sanitizers.h"

using namespace twinshade;

namespace {

std::string refusal(std::uint64_t bytes) {
  try {
    require_memory(bytes, "a frame of 16384x16384", "choose a smaller --size");
  } catch (const UserError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("what does not fit is refused with the size needed and the remedy, what fits is not") {
  CHECK(refusal(0) == "");
  CHECK(refusal(1 << 20) == "");
  const std::string message = refusal(std::uint64_t(1) << 60);
  CAPTURE(message);
  CHECK(message.find("a frame of 16384x16384 needs 1073741824.0 GiB of memory, but ") == 0);
  CHECK(message.find(" GiB are available: choose a smaller --size") != std::string::npos);
  CHECK(message.find('\n') == std::string::npos);
}

TEST_CASE("a limit of address space counts") {
  if (kShadowMemory) {
    MESSAGE("not tested: sanitizers map more addresses than any limit allows");
    return;
  }
  rlimit old{};
  REQUIRE(getrlimit(RLIMIT_AS, &old) == 0);
  rlimit lower = old;
  lower.rlim_cur = rlim_t(1) << 16;  // less than is mapped already
  REQUIRE(setrlimit(RLIMIT_AS, &lower) == 0);
  const std::uint64_t left = available_memory();
  REQUIRE(setrlimit(RLIMIT_AS, &old) == 0);
  CHECK(left == 0);
  CHECK(available_memory() > 0);
}

TEST_CASE("peak memory holds what was touched") {
  restart_peak_memory();
  const std::uint64_t before = peak_memory();
  std::vector<char> touched(64 << 20, 1);
  CHECK(touched[touched.size() / 2] == 1);
  CHECK(peak_memory() >= before);
  CHECK(peak_memory() >= (60u << 20));
}
