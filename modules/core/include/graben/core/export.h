#pragma once

/// Around what a public header declares: that is visible outside the library. All else is hidden, as libraries are compiled with -fvisibility=hidden.
#if defined(__GNUC__)
#define GRABEN_EXPORT_BEGIN _Pragma("GCC visibility push(default)")
#define GRABEN_EXPORT_END _Pragma("GCC visibility pop")
#else
#define GRABEN_EXPORT_BEGIN
#define GRABEN_EXPORT_END
#endif
