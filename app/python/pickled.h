// Pickling of states and reports, so that they can be passed to other processes.
#pragma once

#include "app/python/module.h"
#include "app/python/shell.h"

namespace gridshell::python {

/// A certificate, an event or a report as a tuple of its properties.
pybind11::tuple packed(const Certificate& of);
pybind11::tuple packed(const Event& of);
pybind11::tuple packed(const Done& of);
/// A state as a tuple: its preset as TOML, layout and frame as the bytes of a journal, certificate
/// and constrained joints.
pybind11::tuple packed(const State& of);

/// Restores what packed() made. Raises ValueError if the tuple is of another version; the errors of
/// presets and journals.
void unpack(const pybind11::tuple& from, Certificate& to);
void unpack(const pybind11::tuple& from, Event& to);
void unpack(const pybind11::tuple& from, Done& to);
void unpack(const pybind11::tuple& from, State& to);

/// Makes a class picklable by packed() and unpack().
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
