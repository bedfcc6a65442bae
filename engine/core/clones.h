// One source, two instruction sets.
#pragma once

// Functions marked so are compiled twice: for plain x86-64 and for x86-64-v3 (AVX2, FMA). The copy
// that the processor can run is picked by its features when the program starts. (An `arch=` that
// names a model, like haswell, would be picked on exactly that model and on no later one.)
// Elsewhere the mark is empty.
//
// What such a function calls is inlined (`flatten`), else it would run as plain x86-64 code. The
// two copies must agree on the layout of all data that they share: a vector type wider than 16
// bytes has 16-byte alignment in one and 32 in the other unless its alignment is stated.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__)
#define GRIDSHELL_CLONES __attribute__((flatten, target_clones("arch=x86-64-v3", "default")))
#else
#define GRIDSHELL_CLONES
#endif
