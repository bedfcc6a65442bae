// Numbers as numpy arrays that look into them: nothing is copied, and nothing can be written.
#pragma once

#include <pybind11/numpy.h>

#include <Eigen/Core>
#include <vector>

namespace gridshell::python {
namespace py = pybind11;

/// An array over memory that `owner` keeps for as long as the array lives.
template <class Number>
py::array_t<Number> view(const Number* data, const std::vector<py::ssize_t>& shape,
                         const std::vector<py::ssize_t>& strides, const py::object& owner) {
  py::array_t<Number> array(shape, strides, data, owner);
  py::detail::array_proxy(array.ptr())->flags &= ~py::detail::npy_api::NPY_ARRAY_WRITEABLE_;
  return array;
}

inline py::array_t<double> view(const Eigen::VectorXd& numbers, const py::object& owner) {
  return view(numbers.data(), {numbers.size()}, {sizeof(double)}, owner);
}

/// A row a point.
inline py::array_t<double> view(const Eigen::Matrix3Xd& points, const py::object& owner) {
  return view(points.data(), {points.cols(), 3}, {3 * sizeof(double), sizeof(double)}, owner);
}

inline py::array_t<int> view(const std::vector<int>& numbers, const py::object& owner) {
  return view(numbers.data(), {py::ssize_t(numbers.size())}, {sizeof(int)}, owner);
}

}  // namespace gridshell::python
