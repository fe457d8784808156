// SPDX-License-Identifier: Apache-2.0
#include "NumberType.h"

#include <openvdb_spheretree/base/EnumNames.h>

namespace openvdb_spheretree {

namespace {

using detail::Named;

constexpr std::array<Named<NumberType>, 12> kTypes = {{{NumberType::Bool, "bool"},
    {NumberType::Int8, "int8"}, {NumberType::UInt8, "uint8"}, {NumberType::Int16, "int16"},
    {NumberType::UInt16, "uint16"}, {NumberType::Int32, "int32"}, {NumberType::UInt32, "uint32"},
    {NumberType::Int64, "int64"}, {NumberType::UInt64, "uint64"}, {NumberType::Float16, "float16"},
    {NumberType::Float32, "float32"}, {NumberType::Float64, "float64"}}};

} // namespace

int bytesOf(NumberType type)
{
    switch (type) {
    case NumberType::Bool:
    case NumberType::Int8:
    case NumberType::UInt8: return 1;
    case NumberType::Int16:
    case NumberType::UInt16:
    case NumberType::Float16: return 2;
    case NumberType::Int32:
    case NumberType::UInt32:
    case NumberType::Float32: return 4;
    default: return 8;
    }
}

const char* toString(NumberType type) { return detail::nameOf(kTypes, type); }

NumberType numberTypeFromString(const std::string& text)
{
    return detail::fromName(kTypes, "type", text);
}

} // namespace openvdb_spheretree
