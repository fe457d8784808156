// SPDX-License-Identifier: Apache-2.0
/// @file DataFolder.h
/// @brief Where the files are that tests read.

#pragma once

#include <string>

namespace spheretree_test {

/// @param name  below tests/data, with folders
std::string dataPath(const std::string& name);

/// @return the bytes of a file of tests/data that is packed there by gzip, with `.gz` behind its name.
std::string unpackedData(const std::string& name);

} // namespace spheretree_test
