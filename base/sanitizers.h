// Which sanitizer this build is compiled for.
#pragma once

// g++ defines __SANITIZE_...__, clang++ has __has_feature.
#if defined(__has_feature)
#define TWINSHADE_HAS_FEATURE(name) __has_feature(name)
#else
#define TWINSHADE_HAS_FEATURE(name) 0
#endif

namespace twinshade {

#if defined(__SANITIZE_THREAD__) || TWINSHADE_HAS_FEATURE(thread_sanitizer)
inline constexpr bool kThreadSanitizer = true;
#else
inline constexpr bool kThreadSanitizer = false;
#endif

// Address and thread sanitizers map terabytes of addresses, so that a limit of address space means nothing.
#if defined(__SANITIZE_ADDRESS__) || TWINSHADE_HAS_FEATURE(address_sanitizer)
inline constexpr bool kShadowMemory = true;
#else
inline constexpr bool kShadowMemory = kThreadSanitizer;
#endif

}  // namespace twinshade

#undef TWINSHADE_HAS_FEATURE
