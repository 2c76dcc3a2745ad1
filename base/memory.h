// How much memory there is, and refusing in one line what cannot fit.
#pragma once

#include <cstdint>
#include <string>

namespace twinshade {

// Bytes that this process may still take: the least of what the system has free or can free at once (/proc/meminfo),
// of what its control groups leave (version 2), and of its own limit of address space (ulimit -v). UINT64_MAX where
// nothing of that can be read.
std::uint64_t available_memory();

// UserError "WHAT needs 6.3 GiB of memory, but 1.2 GiB are available: REMEDY" where `bytes` is more than is available.
// To be asked before allocating.
void require_memory(std::uint64_t bytes, const std::string& what, const std::string& remedy);

// The most memory, in bytes, that this process has held in RAM since restart_peak_memory (or its start, where the
// system does not let it be restarted); 0 where the system does not say.
std::uint64_t peak_memory();
void restart_peak_memory();

}  // namespace twinshade
