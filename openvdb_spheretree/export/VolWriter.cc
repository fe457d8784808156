// SPDX-License-Identifier: Apache-2.0
#include "VolWriter.h"

#include "ExportText.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/voxel/MaskGrids.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/Exceptions.h>
#include <openvdb/tree/ValueAccessor.h>

#include <zlib.h>

#include <array>
#include <new>
#include <ostream>
#include <vector>

namespace openvdb_spheretree {

namespace {

using openvdb::Coord;
using openvdb::CoordBBox;

constexpr int64_t kMaxSide = int64_t(1) << 20; ///< as readers of the format have it
constexpr int64_t kMaxVoxels = int64_t(1) << 40;
constexpr uint8_t kInside = 255;

/// Bytes to a zlib stream.
class DeflateStream {
public:
    explicit DeflateStream(std::ostream& out) : mOut(out)
    {
        if (deflateInit(&mZlib, Z_BEST_SPEED) != Z_OK) throw std::bad_alloc();
    }
    ~DeflateStream() { deflateEnd(&mZlib); }
    DeflateStream(const DeflateStream&) = delete;
    DeflateStream& operator=(const DeflateStream&) = delete;

    void write(std::vector<uint8_t>& bytes) { deflate(bytes.data(), bytes.size(), Z_NO_FLUSH); }
    void finish()
    {
        deflate(nullptr, 0, Z_FINISH);
        mOut.flush();
        requireGood();
    }

private:
    void deflate(uint8_t* bytes, std::size_t count, int flush)
    {
        mZlib.next_in = bytes;
        mZlib.avail_in = uInt(count); // a row
        do {
            mZlib.next_out = mBuffer.data();
            mZlib.avail_out = uInt(mBuffer.size());
            ::deflate(&mZlib, flush);
            mOut.write(reinterpret_cast<const char*>(mBuffer.data()),
                std::streamsize(mBuffer.size() - mZlib.avail_out));
            requireGood();
        } while (mZlib.avail_out == 0);
    }
    void requireGood()
    {
        if (!mOut) OPENVDB_THROW(openvdb::IoError, "cannot write the .vol: is the disk full?");
    }

    std::ostream& mOut;
    z_stream mZlib{};
    std::array<uint8_t, 1 << 16> mBuffer;
};

CoordBBox boxOf(const openvdb::BoolGrid& object)
{
    const CoordBBox box = object.evalActiveVoxelBoundingBox();
    if (object.empty() || box.empty()) OPENVDB_THROW(openvdb::ValueError, "the object is empty");
    double voxels = 1;
    for (int axis = 0; axis < 3; ++axis) {
        const int64_t side = int64_t(box.max()[axis]) - box.min()[axis] + 1;
        voxels *= double(side);
        if (side <= kMaxSide && voxels <= double(kMaxVoxels)) continue;
        OPENVDB_THROW(openvdb::ValueError,
            "a .vol holds all voxels of the object's box, empty ones too, and here they are too "
            "many (2^20 "
            "along an axis, and 2^40 in all, are the most): write a .vdb");
    }
    return box;
}

void writeHeader(const openvdb::BoolGrid& object, const CoordBBox& box, std::ostream& out)
{
    const bool isCube = hasCubicVoxels(object.transform());
    const openvdb::Vec3d size =
        isCube ? openvdb::Vec3d(voxelSizeOf(object.transform())) : object.voxelSize();
    detail::ExportText text(out, 0);
    const Coord dim = box.dim();
    for (int axis = 0; axis < 3; ++axis)
        text << "Center-"
             << "XYZ"[axis] << ": " << dim[axis] / 2 << '\n';
    for (int axis = 0; axis < 3; ++axis) text << "XYZ"[axis] << ": " << dim[axis] << '\n';
    text << "Voxel-Size: ";
    for (int axis = 0; axis < (isCube ? 1 : 3); ++axis) {
        if (axis > 0) text << ' ';
        text.real(size[axis]);
    }
    text << "\nAlpha-Color: 0\nVoxel-Endian: 0\nInt-Endian: 0123\nVersion: 3\n.\n";
    text.finish();
}

} // namespace

void writeVolFile(
    const openvdb::BoolGrid& object, std::ostream& out, openvdb::util::NullInterrupter* interrupter)
{
    const CoordBBox box = boxOf(object);
    writeHeader(object, box, out);
    DeflateStream stream(out);
    const openvdb::BoolGrid::ConstAccessor accessor = object.getConstAccessor();
    std::vector<uint8_t> row(std::size_t(box.dim().x()));
    for (int64_t z = box.min().z(); z <= box.max().z(); ++z) {
        const double slices = double(box.max().z()) - box.min().z() + 1;
        detail::checkInterrupt(interrupter, int(100 * (double(z) - box.min().z()) / slices));
        for (int64_t y = box.min().y(); y <= box.max().y(); ++y) {
            detail::checkInterrupt(interrupter);
            Coord at(box.min().x(), int32_t(y), int32_t(z));
            for (uint8_t& value : row) {
                value = accessor.isValueOn(at) ? kInside : 0;
                at.x() += 1;
            }
            stream.write(row);
        }
    }
    stream.finish();
}

} // namespace openvdb_spheretree
