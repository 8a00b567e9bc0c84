// What is needed of the operating system: Mutex, Condition and Thread, current_thread, give_way. The same
// names from one of three headers; without threads, none can be started.
#pragma once

#if defined(_WIN32)
#include "threads/platform_windows.h"
#elif defined(__EMSCRIPTEN__) && !defined(__EMSCRIPTEN_PTHREADS__)
#include "threads/platform_none.h"
#else
#include "threads/platform_posix.h"
#endif
