// Whether a sanitizer watches, under which everything takes five to twenty times as long.
#pragma once

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define LKS_TEST_SANITISED 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
#define LKS_TEST_SANITISED 1
#endif
#endif

namespace support {

// What only takes minutes of what shorter tests do, too, is skipped there.
#if defined(LKS_TEST_SANITISED)
inline constexpr bool sanitised = true;
#else
inline constexpr bool sanitised = false;
#endif

} // namespace support
