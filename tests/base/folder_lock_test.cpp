#include "base/folder_lock.h"

#include <doctest/doctest.h>

#include <atomic>
#include <chrono>
#include <filesystem>
#include <optional>
#include <thread>

#include "tests/scenes/temporary_folder.h"

namespace twinshade {

TEST_CASE("a locked folder makes others wait until it is let go, and has no more files than before") {
  const TemporaryFolder folder;
  std::optional<FolderLock> mine(std::in_place, folder.path.string());
  std::atomic<bool> entered = false;
  std::thread other([&] {
    const FolderLock lock((folder.path / ".").string());
    entered = true;
  });
  std::this_thread::sleep_for(std::chrono::milliseconds(50));
  CHECK_FALSE(entered);
  mine.reset();
  other.join();
  CHECK(entered);
  CHECK(std::filesystem::is_empty(folder.path));
}

TEST_CASE("a folder that is not there is not waited for") {
  const TemporaryFolder folder;
  const FolderLock first((folder.path / "none").string()), second((folder.path / "none").string());
  CHECK_FALSE(std::filesystem::exists(folder.path / "none"));
}

}  // namespace twinshade
