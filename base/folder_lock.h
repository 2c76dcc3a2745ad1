// A folder that one process at a time changes several files of.
#pragma once

#include <string>

namespace twinshade {

// While it lives, others that lock the same folder wait. It leaves no file behind and goes with its process. A file
// system that has no locks, or a folder that cannot be opened, is not locked: then it is as if one were alone.
class FolderLock {
 public:
  explicit FolderLock(const std::string& folder);
  ~FolderLock();
  FolderLock(const FolderLock&) = delete;
  FolderLock& operator=(const FolderLock&) = delete;

 private:
  int descriptor_;  // -1: none
};

}  // namespace twinshade
