// SPDX-License-Identifier: Apache-2.0
/// @file Errors.h
/// @brief Exceptions of the library, of OpenVDB and of the command's files as exceptions of Python, by kind.
///
/// | what went wrong                              | in Python                        |
/// |----------------------------------------------|----------------------------------|
/// | an argument, or the object that it stands for | spheretree.InputError, a ValueError |
/// | a file: it cannot be read or written, or is damaged | OSError                    |
/// | memory                                       | MemoryError                      |
/// | Ctrl-C                                       | KeyboardInterrupt                |
/// | no thread can be started, and defects        | RuntimeError                     |

#pragma once

#include <pybind11/pybind11.h>

#include <stdexcept>
#include <string>

namespace binding {

/// An argument is wrong. The message names it, and says what to do.
class InputError : public std::runtime_error {
public:
    using std::runtime_error::runtime_error;
};

/// @return text for Python; what is no UTF-8, as in names of a damaged file, is replaced.
pybind11::str textOf(const std::string& text);

void bindErrors(pybind11::module_& module);

} // namespace binding
