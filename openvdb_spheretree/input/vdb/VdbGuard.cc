// SPDX-License-Identifier: Apache-2.0
#include "VdbGuard.h"

#include "NodeWalk.h"
#include "ValueBlock.h"
#include <openvdb_spheretree/base/Memory.h>

#include <openvdb/io/GridDescriptor.h>

namespace openvdb_spheretree::detail {

VdbGuard::VdbGuard(std::streambuf& source, DelayedMetadata treatment)
    : mWindow(source), mTreatment(treatment)
{}

void VdbGuard::takeAll()
{
    while (takePiece()) mWindow.clear();
}

VdbGuard::int_type VdbGuard::underflow()
{
    mWindow.clear();
    while (mWindow.size() == 0) {
        if (!takePiece()) return traits_type::eof();
    }
    setg(mWindow.data(), mWindow.data(), mWindow.data() + mWindow.size());
    return traits_type::to_int_type(*gptr());
}

VdbGuard::pos_type VdbGuard::seekoff(
    off_type offset, std::ios_base::seekdir direction, std::ios_base::openmode)
{
    if (offset != 0 || direction != std::ios_base::cur) return pos_type(off_type(-1));
    return pos_type(off_type(mWindow.position()) - (egptr() - gptr()));
}

/// @return false at the end of the last grid; what follows is nobody's.
bool VdbGuard::takePiece()
{
    if (!mStarted) {
        mFile = takeFileHead(mWindow, mTreatment);
        mGridsLeft = mFile.gridCount;
        mStarted = true;
        return true;
    }
    if (mBuffers) {
        if (!mBuffers->takeSome(mWindow)) endGrid();
        return true;
    }
    if (mGridsLeft == 0) return false;
    takeGrid();
    return true;
}

void VdbGuard::takeGrid()
{
    mGrid = takeGridHead(mWindow, mFile, mTreatment);
    mNames.push_back(mGrid.name);
    const auto type = valueTypeOf(mGrid.type);
    if (!type) mWindow.fail("grids of type '" + mGrid.type + "' are not read");
    if (mGrid.instance) {
        endGrid();
        return;
    }
    BlockFormat format;
    format.fileVersion = mFile.fileVersion;
    format.compression = mGrid.compression;
    format.half = mGrid.half;
    format.type = *type;
    GridNodes nodes = takeNodes(mWindow, format);
    mNodeBytes += bytesOf(nodes, *type);
    const std::string name = openvdb::io::GridDescriptor::stripSuffix(mGrid.name);
    requireMemory(mNodeBytes, "the nodes of the grids up to '" + name + "'",
        "voxels far apart take nodes of their own; use a larger voxel, or split the file");
    mBuffers = walkBuffers(format, std::move(nodes.leaves), std::move(mGrid.delayed));
}

/// With delayed loading OpenVDB goes where the descriptor says.
void VdbGuard::endGrid()
{
    const bool seeks = mTreatment == DelayedMetadata::Keep && mFile.hasOffsets;
    if (seeks
        && (mGrid.saidBegin != int64_t(mGrid.begin)
            || mGrid.saidEnd != int64_t(mWindow.position()))) {
        mWindow.fail("a grid is not where the file says");
    }
    mBuffers.reset();
    --mGridsLeft;
}

} // namespace openvdb_spheretree::detail
