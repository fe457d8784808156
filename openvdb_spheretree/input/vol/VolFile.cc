// SPDX-License-Identifier: Apache-2.0
/// @file VolFile.cc
/// @brief Reader of `.vol` and `.longvol` files that never holds the whole volume.
///
/// 1. readVolHeader(): VolHeader.h.
/// 2. VolStream:       the values in file order, inflated as they are asked for; knows exactly
///                     where they must end.
/// 3. SlabToLeaves:    eight z-slices make one layer of leaves: each leaf is built from its 64 rows
///                     of eight voxels; rows are tested as words, so empty space costs one read.
/// The next slab is inflated while the leaves of this one are built.
///
/// Cost: one pass over X*Y*Z values (0.25 s of inflating for 512^3), and the leaves that hold one.

#include "VolFile.h"

#include "VolHeader.h"
#include <openvdb_spheretree/base/Parallel.h>
#include <openvdb_spheretree/base/Stage.h>
#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/voxel/LeafLayout.h>
#include <openvdb_spheretree/voxel/MakeGrid.h>

#include <tbb/parallel_invoke.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ios>
#include <limits>
#include <memory>
#include <new>
#include <string>
#include <system_error>
#include <vector>

namespace openvdb_spheretree {
namespace {

using detail::VolHeader;
using openvdb::Coord;
using openvdb::IoError;

constexpr std::size_t kInputBytes = 1 << 16;
constexpr std::uint64_t kLeafSide = kLeafDim; // as wide as what it is compared with

[[noreturn]] void fail(const std::string& path, const std::string& what)
{
    throw IoError(path + ": " + what);
}

/// The bytes of the values, in file order.
class VolStream {
public:
    VolStream(const std::string& path, std::ifstream& file, const VolHeader& header)
        : mPath(path), mFile(file), mInflating(header.version == 3)
    {
        if (!mInflating) return;
        mInput.resize(kInputBytes);
        if (inflateInit(&mZlib) != Z_OK) throw std::bad_alloc();
    }
    ~VolStream()
    {
        if (mInflating) inflateEnd(&mZlib);
    }
    VolStream(const VolStream&) = delete;
    VolStream& operator=(const VolStream&) = delete;

    void read(std::uint8_t* out, std::uint64_t bytes)
    {
        if (mInflating) {
            if (inflateInto(out, bytes) < bytes) {
                fail(mPath, "the zlib stream ends before the X*Y*Z values of the header");
            }
            return;
        }
        mFile.read(reinterpret_cast<char*>(out), static_cast<std::streamsize>(bytes));
        if (static_cast<std::uint64_t>(mFile.gcount()) < bytes) {
            fail(mPath, "cannot read the values: the file ends early");
        }
    }

    /// Call after the last value: the stream must end here, with its checksum, and so must the
    /// file. (A raw file's length was checked against its header already.)
    void finish()
    {
        if (!mInflating) return;
        std::uint8_t extra = 0;
        if (inflateInto(&extra, 1) != 0) {
            fail(mPath, "the zlib stream holds more than the X*Y*Z values of the header");
        }
        if (mZlib.avail_in > 0 || mFile.peek() != std::ifstream::traits_type::eof()) {
            fail(mPath, "bytes follow the end of the zlib stream");
        }
    }

private:
    /// @return how many bytes came; fewer than asked for only where the stream ends soundly.
    std::uint64_t inflateInto(std::uint8_t* out, std::uint64_t bytes)
    {
        std::uint64_t done = 0;
        while (done < bytes && !mEnded) {
            if (mZlib.avail_in == 0) refill();
            const auto room = static_cast<uInt>(std::min<std::uint64_t>(bytes - done, 1u << 30));
            mZlib.next_out = out + done;
            mZlib.avail_out = room;
            const int code = inflate(&mZlib, Z_NO_FLUSH);
            done += room - mZlib.avail_out;
            if (code == Z_MEM_ERROR) throw std::bad_alloc();
            if (code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR) {
                fail(mPath,
                    "the zlib stream is damaged"
                        + (mZlib.msg ? " (" + std::string(mZlib.msg) + ")" : std::string()));
            }
            mEnded = code == Z_STREAM_END;
        }
        return done;
    }

    void refill()
    {
        mFile.read(
            reinterpret_cast<char*>(mInput.data()), static_cast<std::streamsize>(mInput.size()));
        if (mFile.gcount() == 0) fail(mPath, "the zlib stream is truncated");
        mZlib.next_in = mInput.data();
        mZlib.avail_in = static_cast<uInt>(mFile.gcount());
    }

    const std::string& mPath;
    std::ifstream& mFile;
    bool mInflating;
    bool mEnded = false;
    z_stream mZlib{};
    std::vector<std::uint8_t> mInput;
};

// Leaves

inline openvdb::Int32 valueAt(const std::uint8_t* bytes, openvdb::Int32) { return *bytes; }

inline openvdb::Int64 valueAt(const std::uint8_t* bytes, openvdb::Int64)
{
    std::uint64_t value = 0; // little-endian on every machine
    for (int i = 0; i < 8; ++i) value |= std::uint64_t(bytes[i]) << (8 * i);
    constexpr auto kMax = std::uint64_t(std::numeric_limits<openvdb::Int64>::max());
    return static_cast<openvdb::Int64>(std::min(value, kMax));
}

inline bool anyBit(const std::uint8_t* bytes, std::size_t count)
{
    std::uint64_t any = 0;
    for (; count >= 8; bytes += 8, count -= 8) {
        std::uint64_t word;
        std::memcpy(&word, bytes, 8);
        any |= word;
    }
    if (count == 0) return any != 0;
    std::uint64_t rest = 0;
    std::memcpy(&rest, bytes, count);
    return (any | rest) != 0;
}

/// Up to eight slices as leaves.
template <typename TreeT>
class SlabToLeaves {
public:
    using Leaf = typename TreeT::LeafNodeType;
    using Value = typename TreeT::ValueType;

    SlabToLeaves(const VolHeader& header, const std::uint8_t* slab, std::uint64_t z0)
        : mHeader(header), mSlab(slab), mZ0(z0), mNz(std::min(kLeafSide, header.dim[2] - z0))
    {}

    /// Leaves are built in parallel, a row of leaves a task, and added in a fixed order.
    void addTo(TreeT& tree) const
    {
        std::vector<std::vector<std::unique_ptr<Leaf>>> rows((mHeader.dim[1] + 7) / kLeafSide);
        detail::parallelFor(rows.size(), nullptr, [&](std::size_t row) {
            for (std::uint64_t x = 0; x < mHeader.dim[0]; x += kLeafSide) {
                if (auto leaf = makeLeaf(x, row * kLeafSide)) rows[row].push_back(std::move(leaf));
            }
        });
        openvdb::tree::ValueAccessor<TreeT> accessor(tree);
        for (auto& row : rows) {
            for (auto& leaf : row) accessor.addLeaf(leaf.release());
        }
    }

private:
    /// @return null where all voxels are 0.
    std::unique_ptr<Leaf> makeLeaf(std::uint64_t x0, std::uint64_t y0) const
    {
        const std::uint64_t nx = std::min(kLeafSide, mHeader.dim[0] - x0);
        const std::uint64_t ny = std::min(kLeafSide, mHeader.dim[1] - y0);
        std::unique_ptr<Leaf> leaf;
        for (std::uint64_t z = 0; z < mNz; ++z) {
            for (std::uint64_t y = 0; y < ny; ++y) {
                const std::uint8_t* row = mSlab
                    + ((z * mHeader.dim[1] + y0 + y) * mHeader.dim[0] + x0) * mHeader.bytesPerValue;
                if (!anyBit(row, nx * mHeader.bytesPerValue)) continue;
                if (!leaf) leaf = std::make_unique<Leaf>(Coord(int(x0), int(y0), int(mZ0)));
                addRow(*leaf, row, nx, (y << 3) | z);
            }
        }
        return leaf;
    }

    /// @param offset  in the leaf of the row's first voxel; its next voxel in x is 64 further on
    void addRow(Leaf& leaf, const std::uint8_t* row, std::uint64_t nx, std::uint64_t offset) const
    {
        for (std::uint64_t x = 0; x < nx; ++x) {
            const Value value = valueAt(row + x * mHeader.bytesPerValue, Value());
            if (value == 0) continue;
            const auto n = static_cast<openvdb::Index>((x << 6) | offset);
            leaf.setValueOn(n, value);
        }
    }

    const VolHeader& mHeader;
    const std::uint8_t* mSlab;
    std::uint64_t mZ0, mNz;
};

template <typename GridT>
typename GridT::Ptr readValues(
    VolStream& stream, const VolHeader& header, openvdb::util::NullInterrupter* interrupter)
{
    using Tree = typename GridT::TreeType;
    const std::uint64_t nz = header.dim[2];
    const std::uint64_t slabBytes = header.sliceBytes() * std::min(kLeafSide, nz);
    // Not value-initialised: pages are first touched by what the file really holds.
    std::unique_ptr<std::uint8_t[]> slab(new std::uint8_t[slabBytes]);
    std::unique_ptr<std::uint8_t[]> next(new std::uint8_t[nz > kLeafSide ? slabBytes : 0]);
    const auto readSlab = [&](std::uint8_t* out, std::uint64_t z) {
        if (z < nz) stream.read(out, header.sliceBytes() * std::min(kLeafSide, nz - z));
    };

    auto grid = detail::makeGrid<GridT>();
    readSlab(slab.get(), 0);
    for (std::uint64_t z = 0; z < nz; z += kLeafSide) {
        detail::checkInterrupt(interrupter, int(100 * z / nz));
        tbb::parallel_invoke([&] { readSlab(next.get(), z + kLeafSide); },
            [&] { SlabToLeaves<Tree>(header, slab.get(), z).addTo(grid->tree()); });
        slab.swap(next);
    }
    stream.finish();
    return grid;
}

openvdb::math::Transform::Ptr transformOf(const std::string& path, const VolHeader& header)
{
    try {
        const auto& size = header.voxelSize;
        if (size[0] == size[1] && size[1] == size[2]) {
            return openvdb::math::Transform::createLinearTransform(size[0]);
        }
        return std::make_shared<openvdb::math::Transform>(openvdb::math::MapBase::Ptr(
            new openvdb::math::ScaleMap(openvdb::Vec3d(size[0], size[1], size[2]))));
    } catch (const openvdb::Exception&) { // OpenVDB refuses transforms that are nearly singular
        fail(path, "header key 'Voxel-Size' is too small for an OpenVDB transform");
    }
}

/// @return the size of the file, after making sure that it is one.
std::uint64_t fileSizeOf(const std::string& path)
{
    std::error_code error;
    const auto status = std::filesystem::status(path, error);
    if (!std::filesystem::exists(status)) fail(path, "no such file");
    if (std::filesystem::is_directory(status)) fail(path, "is a directory, not a .vol file");
    if (!std::filesystem::is_regular_file(status)) {
        fail(path, "is not a regular file; copy the volume to one first");
    }
    const std::uint64_t bytes = std::filesystem::file_size(path, error);
    if (error) fail(path, "cannot be read: " + error.message());
    return bytes;
}

} // namespace

bool isVolFileName(const std::string& path)
{
    const std::string extension = detail::lowerExtension(path);
    return extension == ".vol" || extension == ".longvol";
}

openvdb::GridBase::Ptr readVolFile(const std::string& path,
    openvdb::util::NullInterrupter* interrupter, const std::string& shownAs)
{
    const std::string& name = shownAs.empty() ? path : shownAs;
    const std::uint64_t fileBytes = fileSizeOf(path);
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(name, "cannot be opened for reading");
    file.exceptions(std::ios::badbit); // a reading that fails is no end of the file
    try {
        const VolHeader header = detail::readVolHeader(name, file, fileBytes);
        const openvdb::math::Transform::Ptr transform = transformOf(name, header);
        VolStream stream(name, file, header);
        const detail::Stage stage("Reading volume", interrupter, nullptr);
        openvdb::GridBase::Ptr grid;
        if (header.bytesPerValue == 8) {
            grid = readValues<openvdb::Int64Grid>(stream, header, interrupter);
        } else {
            grid = readValues<openvdb::Int32Grid>(stream, header, interrupter);
        }
        grid->setName(std::filesystem::path(name).stem().string());
        grid->setTransform(transform);
        return grid;
    } catch (const std::bad_alloc&) {
        fail(name, "not enough memory for the volume that its header keys X, Y, Z ask for");
    } catch (const std::ios_base::failure& error) {
        fail(name, "cannot be read: " + error.code().message());
    }
}

} // namespace openvdb_spheretree
