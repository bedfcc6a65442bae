// One source, two instruction sets.
#pragma once

// Functions marked so are compiled for plain x86-64 and for Haswell (AVX2, FMA); the processor's own is
// picked when the program starts. Elsewhere the mark is empty.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define GRIDSHELL_CLONES __attribute__((target_clones("arch=haswell", "default")))
#else
#define GRIDSHELL_CLONES
#endif
