// A small stack for code whose recursion could be as deep as its input.
#pragma once

#include <gtest/gtest.h>
#include <pthread.h>

#include <cstddef>
#include <functional>

namespace roci::small_stack {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
inline constexpr std::size_t kFrameFactor = 16;  // room between the variables of each frame
#else
inline constexpr std::size_t kFrameFactor = 1;
#endif

/// Runs the function in a thread with a stack of so many bytes (a usual one has 8 MiB), and waits for its end.
inline void on_small_stack(std::function<void()> function, std::size_t bytes = 256 * 1024) {
  pthread_attr_t attributes;
  ASSERT_EQ(pthread_attr_init(&attributes), 0);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, kFrameFactor * bytes), 0);
  pthread_t thread{};
  const auto run = [](void* called) -> void* {
    (*static_cast<std::function<void()>*>(called))();
    return nullptr;
  };
  ASSERT_EQ(pthread_create(&thread, &attributes, run, &function), 0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
}

}  // namespace roci::small_stack
