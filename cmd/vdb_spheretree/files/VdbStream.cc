// SPDX-License-Identifier: Apache-2.0
#include "VdbStream.h"

#include "base/Errors.h"
#include "base/Progress.h"
#include "FdBuffer.h"

#include <openvdb/io/Archive.h>
#include <openvdb/io/File.h>

#include <openvdb_spheretree/input/vdb/VdbGrids.h>

#include <cstring>
#include <fstream>
#include <istream>

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

namespace command {

namespace {

/// Closes what it opened; standard input stays open.
class InputFile {
public:
    explicit InputFile(const std::string& path)
        : mFd(path == "stdin.vdb" ? STDIN_FILENO : open(path.c_str(), O_RDONLY | O_CLOEXEC))
    {
        if (mFd < 0) throwInput("cannot read " + systemError(path));
    }
    InputFile(const InputFile&) = delete;
    InputFile& operator=(const InputFile&) = delete;
    ~InputFile()
    {
        if (mFd != STDIN_FILENO) close(mFd);
    }
    int fd() const { return mFd; }

    /// @return whether it still is what @a path names, unchanged.
    bool isStill(const std::string& path) const
    {
        struct stat opened, named;
        return fstat(mFd, &opened) == 0 && stat(path.c_str(), &named) == 0
            && opened.st_dev == named.st_dev && opened.st_ino == named.st_ino
            && opened.st_size == named.st_size && opened.st_mtim.tv_sec == named.st_mtim.tv_sec
            && opened.st_mtim.tv_nsec == named.st_mtim.tv_nsec;
    }

private:
    int mFd;
};

/// Runs @a read; whatever goes wrong is the file's.
template <typename Read>
auto naming(const std::string& path, const Read& read)
{
    try {
        return read();
    } catch (const std::ios_base::failure&) {
        throwInput(path + ": the file is truncated or damaged");
    } catch (...) {
        rethrowNamed(path, kInput);
    }
}

openvdb::GridPtrVec readWhole(const std::string& path)
{
    const InputFile file(path);
    FdBuffer buffer(file.fd());
    return naming(path, [&] { return openvdb_spheretree::readVdbGrids(buffer); });
}

#ifdef OPENVDB_USE_DELAYED_LOADING

bool worthDelaying(const std::string& path, Loading loading)
{
    struct stat info;
    if (loading == Loading::Whole || path == "stdin.vdb") return false;
    if (!openvdb::io::Archive::isDelayedLoadingEnabled()) return false;
    if (stat(path.c_str(), &info) != 0 || !S_ISREG(info.st_mode)) return false;
    return loading == Loading::Delayed || int64_t(info.st_size) >= kLargeFile;
}

/// @return nothing if the file does not say where its grids are.
openvdb::GridPtrVec readDelayed(const std::string& path)
{
    return naming(path, [&] {
        openvdb::GridPtrVec grids;
        const InputFile input(path);
        FdBuffer buffer(input.fd());
        const auto names = openvdb_spheretree::requireSoundVdb(buffer);
        if (!names) return grids;
        openvdb::io::File file(path);
        file.setCopyMaxBytes(0); // a copy of the file would be one more thing that has to fit
        file.open(/*delayLoad=*/true);
        // OpenVDB has opened it by its name, and must have got what was looked at.
        if (!input.isStill(path)) throwInput("the file was replaced while it was read");
        for (const std::string& name : *names) {
            throwIfStopped();
            grids.push_back(file.readGrid(name));
        }
        return grids;
    });
}

#else // later versions of OpenVDB can be built without

bool worthDelaying(const std::string&, Loading) { return false; }
openvdb::GridPtrVec readDelayed(const std::string&) { return {}; }

#endif

/// The mask words of a leaf may be damaged without any length being wrong.
void checkVoxelCount(const openvdb::GridBase& grid, const std::string& path)
{
    const auto stored =
        grid.getMetadata<openvdb::Int64Metadata>(openvdb::GridBase::META_FILE_VOXEL_COUNT);
    if (!stored) return;
    const auto count = int64_t(grid.activeVoxelCount());
    if (stored->value() == count) return;
    throwInput(path + ": grid '" + oneLine(grid.getName(), 80) + "' has " + std::to_string(count)
        + " active voxels where the file says " + std::to_string(stored->value())
        + ": it is truncated or damaged");
}

/// OpenVDB's own writer, given our stream: io::File would not notice a full disk.
class ArchiveWriter : public openvdb::io::Archive {
public:
    void writeTo(std::ostream& out, const openvdb::GridCPtrVec& grids, bool seekable) const
    {
        openvdb::io::Archive::write(out, grids, seekable, openvdb::MetaMap());
    }
};

/// A header is: magic (8 bytes), file version (4), library version (8), has offsets (1),
/// identifier.
constexpr size_t kTagOffset = 21;
constexpr size_t kTagSize = 36;

/// Two independent 64-bit mixes of a sequence of 8-byte words.
class Digest {
public:
    void add(uint64_t word)
    {
        mFirst = mixed((mFirst ^ word) * 0x9fb21c651e98df25u);
        mSecond = mixed((mSecond + word) * 0xd6e8feb86659fd93u);
    }
    /// @return the form of a UUID of version 8 (RFC 9562: bits of the application's own choice).
    std::string tag() const
    {
        const uint64_t high = (mFirst & ~uint64_t(0xf000)) | 0x8000;
        const uint64_t low = (mSecond & (~uint64_t(0) >> 2)) | uint64_t(1) << 63;
        char text[kTagSize + 1];
        std::snprintf(text, sizeof(text), "%08x-%04x-%04x-%04x-%012llx", unsigned(high >> 32),
            unsigned(high >> 16 & 0xffff), unsigned(high & 0xffff), unsigned(low >> 48),
            static_cast<unsigned long long>(low & 0xffffffffffffu));
        return text;
    }

private:
    static uint64_t mixed(uint64_t x) { return x ^ x >> 29; }
    uint64_t mFirst = 0x243f6a8885a308d3u, mSecond = 0x13198a2e03707344u;
};

/// Needs the stream's identifier to be blanked already.
std::string digestOf(std::iostream& stream, std::streamoff size)
{
    Digest digest;
    std::vector<char> buffer(1 << 20); // a multiple of the size of a word
    stream.seekg(0);
    for (std::streamoff left = size; left > 0;) {
        const auto some = std::min<std::streamoff>(left, std::streamoff(buffer.size()));
        stream.read(buffer.data(), some);
        std::fill(buffer.begin() + some, buffer.end(), '\0');
        for (std::streamoff i = 0; i < some; i += 8) {
            uint64_t word;
            std::memcpy(&word, buffer.data() + i, sizeof(word));
            digest.add(word);
        }
        left -= some;
    }
    digest.add(uint64_t(size));
    return digest.tag();
}

void replaceTag(std::iostream& stream, const std::string& tag)
{
    stream.seekp(kTagOffset);
    stream.write(tag.data(), std::streamsize(tag.size()));
}

} // namespace

openvdb::GridPtrVec readVdb(const std::string& path, Loading loading)
{
    openvdb::GridPtrVec grids;
    if (worthDelaying(path, loading)) grids = readDelayed(path);
    if (grids.empty()) grids = readWhole(path);
    if (grids.empty()) throwInput(path + ": the file holds no grid");
    for (const auto& grid : grids) {
        throwIfStopped();
        checkVoxelCount(*grid, path);
    }
    return grids;
}

void writeVdb(
    std::iostream& out, const openvdb::GridCPtrVec& grids, uint32_t compression, bool seekable)
{
    ArchiveWriter archive;
    archive.setCompression(compression);
    archive.writeTo(out, grids, seekable);
    throwIfStopped();
    out.seekp(0, std::ios::end);
    const std::streamoff size = out.tellp();
    std::string tag(kTagSize, '\0');
    out.seekg(kTagOffset);
    out.read(tag.data(), kTagSize);
    if (tag != archive.getUniqueTag()) return; // another layout: then leave it alone
    replaceTag(out, std::string(kTagSize, '0'));
    replaceTag(out, digestOf(out, size));
    out.seekp(0, std::ios::end);
}

} // namespace command
