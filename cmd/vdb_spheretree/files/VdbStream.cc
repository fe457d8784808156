// SPDX-License-Identifier: Apache-2.0
#include "VdbStream.h"

#include "base/Errors.h"
#include "base/Stop.h"
#include "FdBuffer.h"
#include "InputFile.h"
#include "SpooledInput.h"
#include "VdbDamage.h"
#include "VdbTag.h"

#include <openvdb_spheretree/input/DelayedValues.h>
#include <openvdb_spheretree/input/vdb/VdbGrids.h>

#include <openvdb/io/Archive.h>
#include <openvdb/io/File.h>
#include <openvdb/io/GridDescriptor.h>
#include <openvdb/points/PointDataGrid.h>

#include <algorithm>
#include <iostream>
#include <utility>

#include <sys/stat.h>

namespace command {

namespace {

InputFile inputOf(const std::string& path)
{
    return path == "stdin.vdb" ? InputFile::standardInput() : InputFile(path);
}

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

/// The digest knows that the file is damaged, and not where.
[[noreturn]] void throwChanged(const openvdb::GridPtrVec& grids)
{
    throwInput(
        "the file is damaged: it is not what vdb_spheretree wrote, by the digest in its header: "
        + placeOfDamage(grids) + "; have it written or copied anew");
}

openvdb::GridPtrVec readWhole(const std::string& path)
{
    const InputFile file = inputOf(path);
    FdBuffer buffer(file.fd());
    if (path == "stdin.vdb") requireInput(buffer, path);
    return naming(path, [&] {
        TagReader reader(buffer);
        auto grids = openvdb_spheretree::readVdbGrids(reader);
        if (!reader.isUnchanged()) throwChanged(grids);
        return grids;
    });
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

/// @param byName  grids in the order of their names, those of one name as in the file: io::File's
/// @param names   in the order of the file, made unique
openvdb::GridPtrVec inFileOrder(
    const openvdb::GridPtrVec& byName, const std::vector<std::string>& names)
{
    std::vector<std::pair<std::string, std::size_t>> order; // names as the grids have them
    for (std::size_t i = 0; i < names.size(); ++i) {
        order.emplace_back(openvdb::io::GridDescriptor::stripSuffix(names[i]), i);
    }
    std::sort(order.begin(), order.end());
    if (byName.size() != order.size()) throwInput("the file was replaced while it was read");
    openvdb::GridPtrVec grids(byName.size());
    for (std::size_t i = 0; i < order.size(); ++i) grids[order[i].second] = byName[i];
    return grids;
}

/// All at once, so that grids that share a tree still do.
/// @return nothing if the file does not say where its grids are.
openvdb::GridPtrVec readDelayed(const std::string& path)
{
    return naming(path, [&] {
        openvdb::GridPtrVec grids;
        const InputFile input(path);
        FdBuffer buffer(input.fd());
        TagReader reader(buffer);
        const auto names = openvdb_spheretree::requireSoundVdb(reader);
        const bool isUnchanged = reader.isUnchanged();
        if (!names) return grids;
        openvdb::io::File file(path);
        file.setCopyMaxBytes(0); // a copy of the file would be one more thing that has to fit
        file.open(/*delayLoad=*/true);
        // OpenVDB has opened it by its name, and must have got what was looked at.
        if (!input.isStill(path)) throwInput("the file was replaced while it was read");
        grids = inFileOrder(*file.getGrids(), *names);
        for (const auto& grid : grids) {
            throwIfStopped();
            // Who takes points takes their voxels in place; of them there are few.
            if (grid->isType<openvdb::points::PointDataGrid>()) {
                openvdb_spheretree::requireReadableValues(*grid);
            }
        }
        if (!isUnchanged) throwChanged(grids);
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

/// Values that are still in a damaged file are the input's fault, whoever asks for them.
void requireReadable(const openvdb::GridBase& grid)
{
    try {
        openvdb_spheretree::requireReadableValues(grid);
    } catch (const openvdb::Exception& error) {
        throwInput("grid '" + oneLine(grid.getName(), 80) + "' cannot be read: " + error.what());
    }
}

/// OpenVDB's own writer, given our stream: io::File would not notice a full disk.
class ArchiveWriter : public openvdb::io::Archive {
public:
    void writeTo(std::ostream& out, const openvdb::GridCPtrVec& grids, bool seekable) const
    {
        openvdb::io::Archive::write(out, grids, seekable, openvdb::MetaMap());
    }
};

} // namespace

openvdb::GridPtrVec readVdb(const std::string& path, Loading loading)
{
    openvdb::GridPtrVec grids;
    if (worthDelaying(path, loading)) grids = readDelayed(path);
    if (grids.empty()) grids = readWhole(path);
    if (grids.empty()) throw EmptyError(path + ": the file holds no grid");
    for (const auto& grid : grids) {
        throwIfStopped();
        checkVoxelCount(*grid, path);
    }
    return grids;
}

void writeVdb(
    std::iostream& out, const openvdb::GridCPtrVec& grids, uint32_t compression, bool seekable)
{
    for (const auto& grid : grids) requireReadable(*grid);
    ArchiveWriter archive;
    archive.setCompression(compression);
    archive.writeTo(out, grids, seekable);
    throwIfStopped();
    replaceTag(out, archive.getUniqueTag());
}

} // namespace command
