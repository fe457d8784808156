// SPDX-License-Identifier: Apache-2.0
/// @file VolFile.cc
/// @brief Reader of `.vol` and `.longvol` files that never holds the whole volume.
///
/// 1. readHeader():  strict; nothing is allocated for a header that asks for more than the file can
///                   hold (raw: its bytes; zlib: deflate expands no more than 1032 times).
/// 2. VolStream:     the values in file order, inflated as they are asked for; knows exactly where
///                   they must end.
/// 3. SlabToLeaves:  eight z-slices make one layer of leaves: each leaf is built from its 64 rows
///                   of eight voxels; rows are tested as words, so empty space costs one read.
/// The next slab is inflated while the leaves of this one are built.
///
/// Cost: one pass over X*Y*Z values (0.25 s of inflating for 512^3), and the leaves that hold one.

#include "VolFile.h"

#include "Interrupted.h"
#include "detail/Parallel.h"

#include <tbb/parallel_invoke.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <limits>
#include <map>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace openvdb_spheretree {
namespace {

using openvdb::Coord;
using openvdb::IoError;

constexpr std::size_t kMaxHeaderBytes = 1 << 16;
constexpr std::uint64_t kMaxSide = 1 << 20;      // so X*Y*Z values of eight bytes stay below 2^64
constexpr std::uint64_t kMaxDeflateRatio = 1032; // 258 bytes in two bits, as zlib documents it
constexpr std::uint64_t kDeflateSlack = 64; // bytes of the stream, for rounding and block headers
constexpr std::size_t kInputBytes = 1 << 16;
constexpr std::uint64_t kLeafDim = 8;

struct VolHeader {
    std::array<std::uint64_t, 3> dim{}; // X, Y, Z
    int version = 2;
    double voxelSize = 1;
    std::uint64_t bytesPerValue = 1;
    std::uint64_t dataOffset = 0; // of the first byte after the header
    std::uint64_t dataBytes = 0;  // from there to the end of the file

    std::uint64_t sliceBytes() const { return dim[0] * dim[1] * bytesPerValue; }
    std::uint64_t volumeBytes() const { return sliceBytes() * dim[2]; }
};

[[noreturn]] void fail(const std::string& path, const std::string& what)
{
    throw IoError(path + ": " + what);
}

std::string lowerExtension(const std::string& path)
{
    std::string text = std::filesystem::path(path).extension().string();
    for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return text;
}

/// Text of a file for use in a message: short, and nothing a terminal would obey.
std::string shown(const std::string& text)
{
    std::string clean = text.substr(0, 40);
    for (char& c : clean) {
        if (!std::isprint(static_cast<unsigned char>(c))) c = '?';
    }
    return "'" + clean + (text.size() > 40 ? "...'" : "'");
}

std::string trimmed(const std::string& text)
{
    const auto begin = text.find_first_not_of(" \t");
    if (begin == std::string::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

// Header

using HeaderFields = std::map<std::string, std::string>;

void addField(const std::string& path, const std::string& line, HeaderFields& fields)
{
    const auto colon = line.find(':');
    const std::string key = trimmed(line.substr(0, colon));
    if (colon == std::string::npos || key.empty()) {
        fail(path, "header line " + shown(line) + " is not 'Key: value'; is this a .vol file?");
    }
    if (!fields.emplace(key, trimmed(line.substr(colon + 1))).second) {
        fail(path, "header key " + shown(key) + " is given twice");
    }
}

/// @return the fields, and in @a offset where the values start.
HeaderFields splitHeader(const std::string& path, const std::string& text, std::uint64_t& offset)
{
    HeaderFields fields;
    std::size_t begin = 0;
    for (;;) {
        const std::size_t end = text.find('\n', begin);
        if (end == std::string::npos) {
            fail(path,
                "header has no line '.' to end it"
                    + std::string(text.size() < kMaxHeaderBytes
                            ? "; the file is truncated or no .vol file"
                            : " within " + std::to_string(kMaxHeaderBytes) + " bytes"));
        }
        std::string line = text.substr(begin, end - begin);
        begin = end + 1;
        if (!line.empty() && line.back() == '\r') line.pop_back();
        if (line == ".") break;
        addField(path, line, fields);
    }
    offset = begin;
    return fields;
}

std::uint64_t sideOf(const std::string& path, const HeaderFields& fields, const std::string& key)
{
    const auto it = fields.find(key);
    if (it == fields.end()) fail(path, "header has no key '" + key + "'");
    const std::string& text = it->second;
    std::uint64_t side = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), side);
    if (error != std::errc() || end != text.data() + text.size() || side < 1 || side > kMaxSide) {
        fail(path,
            "header key '" + key + "' is " + shown(text) + ", not a whole number from 1 to "
                + std::to_string(kMaxSide));
    }
    return side;
}

int versionOf(const std::string& path, const HeaderFields& fields)
{
    const auto it = fields.find("Version");
    if (it == fields.end() || it->second == "2") return 2;
    if (it->second == "3") return 3;
    fail(path,
        "header key 'Version' is " + shown(it->second)
            + "; versions 2 (raw) and 3 (zlib) can be read");
}

double voxelSizeOf(const std::string& path, const HeaderFields& fields)
{
    const auto it = fields.find("Voxel-Size");
    if (it == fields.end()) return 1;
    const std::string& text = it->second;
    double size = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), size);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(size)
        || size <= 0) {
        fail(path, "header key 'Voxel-Size' is " + shown(text) + ", not a number above 0");
    }
    return size;
}

/// Refuse what cannot fit before anything of its size is allocated.
void checkSize(const std::string& path, const VolHeader& header)
{
    const std::string claim = "header keys X, Y, Z ask for " + std::to_string(header.volumeBytes())
        + " bytes of values, but the file holds " + std::to_string(header.dataBytes);
    if (header.version == 2 && header.dataBytes < header.volumeBytes()) {
        fail(path, claim + "; it is truncated, or its header wrong");
    }
    if (header.version == 2 && header.dataBytes > header.volumeBytes()) {
        fail(path, claim + "; nothing may follow the values");
    }
    if (header.version == 3
        && header.volumeBytes() / kMaxDeflateRatio > header.dataBytes + kDeflateSlack) {
        fail(path,
            claim
                + " compressed bytes, which cannot expand to that many; it is truncated, "
                  "or its header wrong");
    }
}

VolHeader readHeader(const std::string& path, std::ifstream& file, std::uint64_t fileBytes)
{
    std::string text(std::min<std::uint64_t>(kMaxHeaderBytes, fileBytes), '\0');
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<std::size_t>(file.gcount()));

    VolHeader header;
    const HeaderFields fields = splitHeader(path, text, header.dataOffset);
    header.dim = {sideOf(path, fields, "X"), sideOf(path, fields, "Y"), sideOf(path, fields, "Z")};
    header.version = versionOf(path, fields);
    header.voxelSize = voxelSizeOf(path, fields);
    header.bytesPerValue = lowerExtension(path) == ".longvol" ? 8 : 1;
    header.dataBytes = fileBytes - header.dataOffset;
    checkSize(path, header);

    file.clear(); // reading a short file to its end has set eofbit
    file.seekg(static_cast<std::streamoff>(header.dataOffset));
    return header;
}

// Values

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
        : mHeader(header), mSlab(slab), mZ0(z0), mNz(std::min(kLeafDim, header.dim[2] - z0))
    {}

    /// Leaves are built in parallel, a row of leaves a task, and added in a fixed order.
    void addTo(TreeT& tree) const
    {
        std::vector<std::vector<std::unique_ptr<Leaf>>> rows(leafCount(1));
        detail::parallelFor(rows.size(), nullptr, [&](std::size_t row) {
            for (std::uint64_t x = 0; x < mHeader.dim[0]; x += kLeafDim) {
                if (auto leaf = makeLeaf(x, row * kLeafDim)) rows[row].push_back(std::move(leaf));
            }
        });
        openvdb::tree::ValueAccessor<TreeT> accessor(tree);
        for (auto& row : rows) {
            for (auto& leaf : row) accessor.addLeaf(leaf.release());
        }
    }

private:
    std::uint64_t leafCount(int axis) const { return (mHeader.dim[axis] + 7) / kLeafDim; }

    const std::uint8_t* rowAt(std::uint64_t x, std::uint64_t y, std::uint64_t z) const
    {
        return mSlab + ((z * mHeader.dim[1] + y) * mHeader.dim[0] + x) * mHeader.bytesPerValue;
    }

    /// @return null where all voxels are 0.
    std::unique_ptr<Leaf> makeLeaf(std::uint64_t x0, std::uint64_t y0) const
    {
        const std::uint64_t nx = std::min(kLeafDim, mHeader.dim[0] - x0);
        const std::uint64_t ny = std::min(kLeafDim, mHeader.dim[1] - y0);
        std::unique_ptr<Leaf> leaf;
        for (std::uint64_t z = 0; z < mNz; ++z) {
            for (std::uint64_t y = 0; y < ny; ++y) {
                const std::uint8_t* row = rowAt(x0, y0 + y, z);
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

/// Tells the interrupter where we are, and that we are done however we leave.
class Progress {
public:
    explicit Progress(openvdb::util::NullInterrupter* interrupter) : mInterrupter(interrupter)
    {
        if (mInterrupter) mInterrupter->start("Reading volume");
    }
    ~Progress()
    {
        if (mInterrupter) mInterrupter->end();
    }
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void at(std::uint64_t z, std::uint64_t nz)
    {
        if (openvdb::util::wasInterrupted(mInterrupter, int(100 * z / nz))) throw Interrupted();
    }

private:
    openvdb::util::NullInterrupter* mInterrupter;
};

template <typename GridT>
typename GridT::Ptr readValues(VolStream& stream, const VolHeader& header, Progress& progress)
{
    using Tree = typename GridT::TreeType;
    const std::uint64_t nz = header.dim[2];
    const std::uint64_t slabBytes = header.sliceBytes() * std::min(kLeafDim, nz);
    // Not value-initialised: pages are first touched by what the file really holds.
    std::unique_ptr<std::uint8_t[]> slab(new std::uint8_t[slabBytes]);
    std::unique_ptr<std::uint8_t[]> next(new std::uint8_t[nz > kLeafDim ? slabBytes : 0]);
    const auto readSlab = [&](std::uint8_t* out, std::uint64_t z) {
        if (z < nz) stream.read(out, header.sliceBytes() * std::min(kLeafDim, nz - z));
    };

    auto grid = GridT::create(0);
    readSlab(slab.get(), 0);
    for (std::uint64_t z = 0; z < nz; z += kLeafDim) {
        progress.at(z, nz);
        tbb::parallel_invoke([&] { readSlab(next.get(), z + kLeafDim); },
            [&] { SlabToLeaves<Tree>(header, slab.get(), z).addTo(grid->tree()); });
        slab.swap(next);
    }
    stream.finish();
    return grid;
}

openvdb::math::Transform::Ptr transformOf(const std::string& path, const VolHeader& header)
{
    try {
        return openvdb::math::Transform::createLinearTransform(header.voxelSize);
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
    const std::string extension = lowerExtension(path);
    return extension == ".vol" || extension == ".longvol";
}

openvdb::GridBase::Ptr readVolFile(
    const std::string& path, openvdb::util::NullInterrupter* interrupter)
{
    const std::uint64_t fileBytes = fileSizeOf(path);
    std::ifstream file(path, std::ios::binary);
    if (!file) fail(path, "cannot be opened for reading");
    const VolHeader header = readHeader(path, file, fileBytes);
    const openvdb::math::Transform::Ptr transform = transformOf(path, header);
    try {
        VolStream stream(path, file, header);
        Progress progress(interrupter);
        openvdb::GridBase::Ptr grid;
        if (header.bytesPerValue == 8) {
            grid = readValues<openvdb::Int64Grid>(stream, header, progress);
        } else {
            grid = readValues<openvdb::Int32Grid>(stream, header, progress);
        }
        grid->setName(std::filesystem::path(path).stem().string());
        grid->setTransform(transform);
        return grid;
    } catch (const std::bad_alloc&) {
        fail(path, "not enough memory for the volume that its header keys X, Y, Z ask for");
    }
}

} // namespace openvdb_spheretree
