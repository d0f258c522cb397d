#pragma once

/// Around what a public header declares: that is visible outside the library, however a program that includes it is compiled. Libraries are compiled with all
/// visible: GCC hides what is instantiated for a type of PCL where these are hidden.
#if defined(__GNUC__)
#define GRABEN_EXPORT_BEGIN _Pragma("GCC visibility push(default)")
#define GRABEN_EXPORT_END _Pragma("GCC visibility pop")
#else
#define GRABEN_EXPORT_BEGIN
#define GRABEN_EXPORT_END
#endif
