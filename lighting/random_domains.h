// What random numbers of a bake are for: the domains given to random_bits(), so that no two uses within a bake share
// numbers.
#pragma once

#include <cstdint>

namespace twinshade {

enum RandomDomain : std::uint64_t {
  // Surfaces: gather.cpp
  kGatherSet = 16,
  kGatherRay,
  kGatherVertex,
  kGatherBright,
  kGatherPlace,
  // Probes: volume_gather.cpp
  kProbeScramble = 32,
  kProbeJitter,
  kProbeSet,
  kProbeVertex,
  kProbeBright,
  kProbePlace,
  // Visibility, which is baked without probes: sphere_sets.cpp, visibility_bake.cpp
  kSphereSet = 32,
  kSphereScramble,
  kSphereJitter,
  kInsideRay,
  // The reference: reference.cpp, and which pixels it is traced for
  kReferenceScramble = 48,
  kReferenceJitter,
  kReferenceBright,
  kReferencePlace,
  kReferenceVertex,
  kReferenceHalf,
  kReferencePixel,
};

}  // namespace twinshade
