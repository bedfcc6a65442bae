// A shared library opened while the program runs, so that the program starts without it.
#pragma once

#include <initializer_list>
#include <string>

#include "engine/core/result.h"

namespace gridshell::render {

/// Stays open to the end of the process: drivers keep threads and exit handlers of their own.
class Library {
 public:
  /// The first of `names` that opens. Errors: Fault::io with what the loader said of each.
  static Result<Library> open(std::initializer_list<const char*> names);

  /// The function `name` as a pointer of type F; null when the library lacks it.
  template <class F>
  F function(const char* name) const {
    return reinterpret_cast<F>(symbol(name));
  }

 private:
  explicit Library(void* handle) : handle_(handle) {}
  void* symbol(const char* name) const;

  void* handle_;
};

}  // namespace gridshell::render
