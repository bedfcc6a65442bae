// Faults as exceptions, one class each.
#pragma once

#include <pybind11/pybind11.h>

#include <string>
#include <utility>

#include "engine/core/result.h"

namespace gridshell::python {
namespace py = pybind11;

/// Adds the classes to the module: Error and, below it, BadInput, NoEquilibrium, IOFailure.
void add_errors(py::module_& module);

/// Raises the exception of an error, its message that of the program.
[[noreturn]] void raise(const Error& error);

/// The value, or the exception.
template <class T>
T value_of(Result<T> result) {
  if (!result) raise(result.error());
  if constexpr (!std::is_void_v<T>) return std::move(*result);
}

}  // namespace gridshell::python
