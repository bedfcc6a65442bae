// What of the module other processes take: states and reports, pickled.
#pragma once

#include "app/python/module.h"
#include "app/python/shell.h"

namespace gridshell::python {

/// A certificate, an event and a report as what their properties say.
pybind11::tuple packed(const Certificate& of);
pybind11::tuple packed(const Event& of);
pybind11::tuple packed(const Done& of);
/// A state with its preset, its layout and its frame, these as bytes of a journal.
pybind11::tuple packed(const State& of);

/// What packed() packed. Raises ValueError, or the errors of a journal: it is none.
void unpack(const pybind11::tuple& from, Certificate& to);
void unpack(const pybind11::tuple& from, Event& to);
void unpack(const pybind11::tuple& from, Done& to);
void unpack(const pybind11::tuple& from, State& to);

/// Makes a class picklable.
template <class Value, class Class>
void add_pickling(Class& type) {
  type.def(pybind11::pickle([](const Value& of) { return packed(of); },
                            [](const pybind11::tuple& from) {
                              auto made = std::make_shared<Value>();
                              unpack(from, *made);
                              return made;
                            }));
}

}  // namespace gridshell::python
