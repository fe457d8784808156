// SPDX-License-Identifier: Apache-2.0
/// @file WriteAdvice.h
/// @brief What to write in place of files that are not written.

#pragma once

#include <string>

namespace command {

/// @param extension  with its dot, in lower case
/// @return `format=yade or format=lammps`, what files that end so want; empty if none does
std::string formatsOf(const std::string& extension);

/// @return what is written for the same tools, such as `.usda` for `.usd`; empty if nothing is known
std::string writeAdvice(const std::string& extension);

} // namespace command
