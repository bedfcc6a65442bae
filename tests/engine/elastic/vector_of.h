// Vectors of numbers that carry their derivatives (Eigen::AutoDiffScalar), for tests of gradients
// and Hessians.
#pragma once

namespace gridshell {

template <class Number>
struct VectorOf {
  Number x, y, z;

  friend VectorOf operator+(const VectorOf& a, const VectorOf& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
  }
  friend VectorOf operator-(const VectorOf& a, const VectorOf& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
  }
  friend VectorOf operator*(const Number& s, const VectorOf& a) {
    return {s * a.x, s * a.y, s * a.z};
  }
  friend Number dot(const VectorOf& a, const VectorOf& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
  }
  friend VectorOf cross(const VectorOf& a, const VectorOf& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
  }
  friend Number norm(const VectorOf& a) { return sqrt(dot(a, a)); }
  friend VectorOf unit(const VectorOf& a) { return Number(Number(1) / norm(a)) * a; }
};

}  // namespace gridshell
