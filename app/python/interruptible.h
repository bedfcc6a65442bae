// Long work that Ctrl-C stops.
#pragma once

#include <pybind11/pybind11.h>

#include <chrono>
#include <future>
#include <optional>

#include "app/python/errors.h"
#include "engine/core/watch.h"

namespace gridshell::python {

/// Calls work(watch) on a thread of its own, without the GIL, while this one waits and, every
/// 20 ms, lets Python answer its signals. What a handler raises (KeyboardInterrupt) cancels the
/// watch, and is raised here once the work has ended. Signals come to Python's main thread alone.
template <class Work>
auto interruptible(const Work& work) {
  Watch watch;
  std::optional<py::error_already_set> raised;
  auto running = std::async(std::launch::async, [&] { return work(watch); });
  for (bool ended = false; !ended;) {
    {
      const py::gil_scoped_release others;
      ended = running.wait_for(std::chrono::milliseconds(20)) == std::future_status::ready;
    }
    if (PyErr_CheckSignals() == 0) continue;
    if (!raised) raised.emplace();
    PyErr_Clear();
    watch.cancel();
  }
  auto result = running.get();
  if (raised) throw py::error_already_set(*raised);
  return result;
}

}  // namespace gridshell::python
