// Which sanitizer this build is compiled for.
#pragma once

namespace twinshade {

#if defined(__SANITIZE_THREAD__)  // g++
inline constexpr bool kThreadSanitizer = true;
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)  // clang++
inline constexpr bool kThreadSanitizer = true;
#else
inline constexpr bool kThreadSanitizer = false;
#endif
#else
inline constexpr bool kThreadSanitizer = false;
#endif

#if defined(__SANITIZE_ADDRESS__)
inline constexpr bool kAddressSanitizer = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
inline constexpr bool kAddressSanitizer = true;
#else
inline constexpr bool kAddressSanitizer = false;
#endif
#else
inline constexpr bool kAddressSanitizer = false;
#endif

// Both keep shadow memory: it maps terabytes of addresses, so that a limit of address space means nothing.
inline constexpr bool kShadowMemory = kAddressSanitizer || kThreadSanitizer;

}  // namespace twinshade
