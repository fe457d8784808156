// SPDX-License-Identifier: Apache-2.0
/// @file FileFields.h
/// @brief Where the fields of a `.vdb` are: whatever OpenVDB reads by one call is a field.
///
/// OpenVDB reads a length, a count, a flag, a mask, a name or a block of values by one call of
/// istream::read(). So a stream that notes the calls knows the layout of any file that can be read,
/// whatever the types and codecs of its grids, without a second description of the format.

#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace spheretree_test {

struct Field {
    std::size_t offset, size; ///< bytes
};

/// @return the fields in the order in which they are read; of a damaged file, those before the
///         damage.
std::vector<Field> vdbFields(const std::string& bytes);

} // namespace spheretree_test
