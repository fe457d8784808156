// SPDX-License-Identifier: Apache-2.0
#include "Errors.h"

#include "base/Errors.h"

#include <openvdb/Exceptions.h>
#include <openvdb_spheretree/base/Interrupted.h>
#include <openvdb_spheretree/base/Text.h>

#include <cstring>
#include <exception>
#include <new>
#include <string>

namespace py = pybind11;

namespace binding {

namespace {

PyObject* sInputError = nullptr; // lives as long as the process

/// OpenVDB has thrown messages of gigabytes.
std::string clipped(const std::exception& error)
{
    const std::string what(error.what(), strnlen(error.what(), 2000));
    return std::string(openvdb_spheretree::detail::withoutType(what));
}

void raise(PyObject* kind, const std::string& message)
{
    PyErr_SetObject(kind, textOf(message).ptr());
}

bool endsWith(const std::string& text, const std::string& end)
{
    return text.size() >= end.size()
        && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void raiseCommandError(const command::CommandError& error)
{
    const std::string message = error.what();
    if (endsWith(message, command::kNoMemory)) return raise(PyExc_MemoryError, message);
    raise(error.code() == command::kUsage ? sInputError : PyExc_OSError, message);
}

void translate(std::exception_ptr error)
{
    try {
        if (error) std::rethrow_exception(error);
    } catch (const InputError& e) {
        raise(sInputError, e.what());
    } catch (const command::CommandError& e) {
        raiseCommandError(e);
    } catch (const openvdb_spheretree::Interrupted&) {
        raise(PyExc_KeyboardInterrupt, "");
    } catch (const openvdb::IoError& e) {
        raise(PyExc_OSError, clipped(e));
    } catch (const openvdb::Exception& e) {
        raise(sInputError, clipped(e));
    } catch (const std::bad_alloc&) {
        raise(PyExc_MemoryError, command::kNoMemory);
    } catch (const std::system_error& e) {
        if (!command::isLackOfThreads(e)) throw;
        raise(PyExc_RuntimeError,
            "no thread can be started: a limit on processes or on memory is reached");
    }
}

} // namespace

py::str textOf(const std::string& text)
{
    PyObject* const decoded = PyUnicode_DecodeUTF8(text.data(), Py_ssize_t(text.size()), "replace");
    if (!decoded) throw py::error_already_set();
    return py::reinterpret_steal<py::str>(decoded);
}

void bindErrors(py::module_& module)
{
    sInputError = PyErr_NewExceptionWithDoc("spheretree.InputError",
        "An argument is wrong: the message names it, and says what to do.", PyExc_ValueError,
        nullptr);
    if (!sInputError) throw py::error_already_set();
    module.attr("InputError") = py::reinterpret_borrow<py::object>(sInputError);
    py::register_exception_translator(translate);
}

} // namespace binding
