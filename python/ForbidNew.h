// SPDX-License-Identifier: Apache-2.0
/// @file ForbidNew.h
/// @brief Keeps Python from making objects of C++ that nobody has constructed.
///
/// `Type.__new__(Type)` of pybind11 makes such an object, whose memory is anything, and the first call of a method
/// reads it. Objects that C++ returns do not come by `tp_new`.

#pragma once

#include <pybind11/pybind11.h>

namespace binding {

inline void forbidNew(const pybind11::object& type)
{
    reinterpret_cast<PyTypeObject*>(type.ptr())->tp_new = [](PyTypeObject* made, PyObject*,
                                                              PyObject*) -> PyObject* {
        PyErr_Format(PyExc_TypeError,
            "%s is a handle: spheretree.volume(), build(), load(), Tree.query() and Scene() make "
            "objects",
            made->tp_name);
        return nullptr;
    };
}

} // namespace binding
