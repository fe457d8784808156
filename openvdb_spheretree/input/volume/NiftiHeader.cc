// SPDX-License-Identifier: Apache-2.0
/// @file NiftiHeader.cc
/// @brief The header of a NIfTI-1 file: 348 bytes of fields at fixed places, in either byte order.
///
/// Debian's libnifti trusts the lengths of a file; the few fields that a volume needs are read here
/// instead. Places of fields are those of the NIfTI-1 standard.

#include "VolumeHeader.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cmath>
#include <cstring>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::IoError;
using openvdb::Vec3d;

class NiftiFields {
public:
    explicit NiftiFields(ByteSource& source)
    {
        source.read(mBytes, sizeof(mBytes));
        for (const bool swapped : {false, true}) {
            mSwapped = swapped;
            const auto size = at<int32_t>(0);
            if (size == kSize) return;
            if (size == 540) throw IoError("is a NIfTI-2, which is not read; save it as NIfTI-1");
        }
        throw IoError("is no NIfTI: it does not begin as one");
    }

    template <typename Number>
    Number at(std::size_t place) const
    {
        uint8_t bytes[sizeof(Number)];
        std::memcpy(bytes, mBytes + place, sizeof(Number));
        if (mSwapped) std::reverse(bytes, bytes + sizeof(Number));
        Number number;
        std::memcpy(&number, bytes, sizeof(Number));
        return number;
    }
    double real(std::size_t place) const { return double(at<float>(place)); }
    Vec3d vector(std::size_t place) const
    {
        return {real(place), real(place + 4), real(place + 8)};
    }
    bool isBigEndian() const { return mSwapped != isBigEndianMachine(); }
    /// @return the four bytes at the end.
    std::string magic() const { return {reinterpret_cast<const char*>(mBytes) + 344, 4}; }

    static constexpr int32_t kSize = 348;

private:
    uint8_t mBytes[kSize];
    bool mSwapped = false;
};

NumberType typeOf(int code)
{
    switch (code) {
    case 2: return NumberType::UInt8;
    case 4: return NumberType::Int16;
    case 8: return NumberType::Int32;
    case 16: return NumberType::Float32;
    case 64: return NumberType::Float64;
    case 256: return NumberType::Int8;
    case 512: return NumberType::UInt16;
    case 768: return NumberType::UInt32;
    case 1024: return NumberType::Int64;
    case 1280: return NumberType::UInt64;
    default:
        throw IoError("its numbers are of NIfTI's type " + std::to_string(code)
            + ", which is not read: integers and floats of up to 64 bits are");
    }
}

std::array<uint64_t, 3> sidesOf(const NiftiFields& fields)
{
    constexpr std::size_t kDim = 40;
    const int count = fields.at<int16_t>(kDim);
    if (count < 1 || count > 7)
        throw IoError("its header says that it has " + std::to_string(count) + " axes");
    std::vector<uint64_t> sides;
    for (int i = 1; i <= count; ++i) {
        const int side = fields.at<int16_t>(kDim + 2 * std::size_t(i));
        if (side < 1)
            throw IoError("side " + std::to_string(i) + " of its array is " + std::to_string(side));
        if (i <= 3 || side != 1) sides.push_back(uint64_t(side));
    }
    return threeSides(sides);
}

/// Method 2 of the NIfTI-1 standard: a rotation by the quaternion (a, b, c, d), of which a is >= 0.
openvdb::Mat4d placeByQuaternion(const NiftiFields& fields, const Vec3d& sizes)
{
    const Vec3d q = fields.vector(256);
    const double b = q[0], c = q[1], d = q[2];
    const double a = std::sqrt(std::max(0.0, 1 - (b * b + c * c + d * d)));
    const double sign = fields.real(76) < 0 ? -1 : 1; // qfac
    const std::array<Vec3d, 3> steps = {
        sizes[0] * Vec3d(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c)),
        sizes[1] * Vec3d(2 * (b * c - a * d), a * a + c * c - b * b - d * d, 2 * (c * d + a * b)),
        sign * sizes[2]
            * Vec3d(2 * (b * d + a * c), 2 * (c * d - a * b), a * a + d * d - b * b - c * c)};
    return placeOf(steps, fields.vector(268));
}

/// Method 3: three rows of a matrix.
openvdb::Mat4d placeByRows(const NiftiFields& fields)
{
    constexpr std::size_t kRows = 280, kRow = 16;
    std::array<Vec3d, 3> steps;
    Vec3d origin;
    for (std::size_t i = 0; i < 3; ++i) {
        const Vec3d row = fields.vector(kRows + kRow * i);
        for (int a = 0; a < 3; ++a) steps[std::size_t(a)][int(i)] = row[a];
        origin[int(i)] = fields.real(kRows + kRow * i + 12);
    }
    return placeOf(steps, origin);
}

std::optional<openvdb::Mat4d> placeOfVoxels(const NiftiFields& fields)
{
    if (fields.at<int16_t>(254) > 0) return placeByRows(fields); // sform_code
    const int count = fields.at<int16_t>(40);
    Vec3d sizes(0); // pixdim; that of an axis that is not there may be anything
    for (int a = 0; a < 3 && a < count; ++a)
        sizes[a] = std::abs(fields.real(80 + 4 * std::size_t(a)));
    if (sizes == Vec3d(0)) return std::nullopt;
    if (fields.at<int16_t>(252) > 0 && sizes[0] > 0 && sizes[1] > 0 && sizes[2] > 0) {
        return placeByQuaternion(fields, sizes);
    }
    const std::array<Vec3d, 3> steps = {
        Vec3d(sizes[0], 0, 0), Vec3d(0, sizes[1], 0), Vec3d(0, 0, sizes[2])};
    return placeOf(steps, Vec3d(0));
}

} // namespace

VolumeHeader readNiftiHeader(ByteSource& source)
{
    const NiftiFields fields(source);
    if (fields.magic() == std::string("ni1\0", 4)) {
        throw IoError("has its numbers in another file (.img); save it as one .nii");
    }
    if (fields.magic() != std::string("n+1\0", 4))
        throw IoError("is no NIfTI-1: it does not say n+1");
    VolumeHeader header;
    header.layout.dim = sidesOf(fields);
    header.layout.type = typeOf(fields.at<int16_t>(70));
    header.layout.bigEndian = fields.isBigEndian();
    const double start = fields.real(108), most = 1 << 30;
    if (!(start >= 352 && start <= most) || start != std::floor(start)) {
        throw IoError("its numbers begin at byte " + std::to_string(start) + ", which cannot be");
    }
    header.byteSkip = uint64_t(start) - NiftiFields::kSize;
    const double slope = fields.real(112), intercept = fields.real(116);
    if (std::isfinite(slope) && std::isfinite(intercept) && slope != 0) { // 0: as they are
        header.layout.slope = slope;
        header.layout.intercept = intercept;
    }
    header.indexToWorld = placeOfVoxels(fields);
    return header;
}

} // namespace openvdb_spheretree::detail
