// The Python module `gridshell`.
#include <pybind11/pybind11.h>

#include "app/preset_library.h"
#include "app/python/errors.h"
#include "app/python/session.h"
#include "app/python/values.h"
#include "engine/core/version.h"

PYBIND11_MODULE(gridshell, module) {
  using namespace gridshell;
  module.doc() =
      "Elastic gridshells: formed, pushed, measured and shown. Millimetres, newtons, millijoules; "
      "z is up.";
  module.attr("__version__") = version();
  python::add_errors(module);
  python::add_values(module);
  python::add_session(module);
  python::add_run(module);
  module.def(
      "presets",
      [] {
        pybind11::list names;
        for (const auto& one : app::embedded_presets()) names.append(one.name);
        return names;
      },
      "Names of the presets that come with the program.");
}
