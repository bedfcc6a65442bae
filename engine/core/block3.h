// 3x3 blocks in vector registers, and functions that are compiled for two instruction sets.
#pragma once

#include <Eigen/Core>

// Functions marked GRIDSHELL_CLONES are compiled twice: for plain x86-64 and for x86-64-v3 (AVX2,
// FMA). When the program starts, the copy for the processor's features is chosen. (An `arch=` with
// the name of a model, like haswell, would be chosen on exactly that model and on no later one.)
// With other processors and compilers the mark is empty, also with the thread sanitizer, which is
// not initialised yet when the copy is chosen.
//
// Calls in such a function are inlined (`flatten`), else they would run as plain x86-64 code. Both
// copies must have the same layout of common data: a vector type wider than 16 bytes has 16-byte
// alignment in one and 32 in the other unless its alignment is declared.
#if defined(__x86_64__) && defined(__GNUC__) && !defined(__clang__) && !defined(__SANITIZE_THREAD__)
#define GRIDSHELL_CLONES __attribute__((flatten, target_clones("arch=x86-64-v3", "default")))
#else
#define GRIDSHELL_CLONES
#endif

// 3x3 blocks in registers: assembly and factorisation spend most of their time on them.

namespace gridshell {

/// x, y, z and a zero: one register with AVX. The alignment is declared, since both copies of a
/// function would assume different ones. Pass it by reference, since the copies would also pass it
/// in different registers.
typedef double Column __attribute__((vector_size(32), aligned(32)));

inline void load(const Eigen::Vector3d& v, Column& column) { column = Column{v[0], v[1], v[2], 0}; }

/// A 3x3 block by columns.
struct alignas(32) Block3 {
  Column column[3] = {};

  /// The block as an Eigen matrix.
  auto matrix() {
    return Eigen::Map<Eigen::Matrix3d, Eigen::Unaligned, Eigen::OuterStride<4>>(
        reinterpret_cast<double*>(column));
  }
  auto matrix() const {
    return Eigen::Map<const Eigen::Matrix3d, Eigen::Unaligned, Eigen::OuterStride<4>>(
        reinterpret_cast<const double*>(column));
  }
};
static_assert(alignof(Block3) == 32 && sizeof(Block3) == 3 * sizeof(Column));

inline void operator+=(Block3& a, const Block3& b) {
  for (int j = 0; j < 3; ++j) a.column[j] += b.column[j];
}

inline void operator-=(Block3& a, const Block3& b) {
  for (int j = 0; j < 3; ++j) a.column[j] -= b.column[j];
}

/// m += a b^T.
inline void add_product(const Column& a, const Eigen::Vector3d& b, Block3& m) {
  for (int j = 0; j < 3; ++j) m.column[j] += a * b[j];
}

/// m += value I.
inline void add_diagonal(double value, Block3& m) {
  m.column[0] += Column{value, 0, 0, 0};
  m.column[1] += Column{0, value, 0, 0};
  m.column[2] += Column{0, 0, value, 0};
}

/// out = m^T.
inline void transpose(const Block3& m, Block3& out) {
  const Column zero = {};
  const Column even = __builtin_shufflevector(m.column[0], m.column[1], 0, 4, 2, 6),
               odd = __builtin_shufflevector(m.column[0], m.column[1], 1, 5, 3, 7),
               last_even = __builtin_shufflevector(m.column[2], zero, 0, 4, 2, 6),
               last_odd = __builtin_shufflevector(m.column[2], zero, 1, 5, 3, 7);
  out.column[0] = __builtin_shufflevector(even, last_even, 0, 1, 4, 5);
  out.column[1] = __builtin_shufflevector(odd, last_odd, 0, 1, 4, 5);
  out.column[2] = __builtin_shufflevector(even, last_even, 2, 3, 6, 7);
}

}  // namespace gridshell
