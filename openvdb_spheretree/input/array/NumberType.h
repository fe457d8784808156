// SPDX-License-Identifier: Apache-2.0
/// @file NumberType.h
/// @brief The types of numbers that arrays in files are made of.

#pragma once

#include <string>

namespace openvdb_spheretree {

enum class NumberType {
    Bool, ///< a byte: 0 is false
    Int8,
    UInt8,
    Int16,
    UInt16,
    Int32,
    UInt32,
    Int64,
    UInt64,
    Float16, ///< IEEE 754, as the others
    Float32,
    Float64
};

/// @return how many bytes a number takes in a file.
int bytesOf(NumberType type);

/// @return its name: bool, int8, uint8, int16, ... float64.
const char* toString(NumberType type);
/// @throw openvdb::ValueError that lists the names, if @a text is none
NumberType numberTypeFromString(const std::string& text);

} // namespace openvdb_spheretree
