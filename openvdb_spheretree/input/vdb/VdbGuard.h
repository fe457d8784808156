// SPDX-License-Identifier: Apache-2.0
/// @file VdbGuard.h
/// @brief A `.vdb` on its way to OpenVDB: bytes are handed on when every length in them is known to be
/// right.
///
/// OpenVDB (version 10) believes what it reads: a length of a block of values is compared with the
/// node's buffer after so many bytes were written into it, a list of attributes is indexed with
/// numbers of the file, memory is taken for lengths of 4 GB. So one flipped byte can overwrite the
/// heap. The guard walks over the file ahead of OpenVDB, by OpenVDB's own rules:
///  1. header, metadata and number of grids,
///  2. for each grid: descriptor, metadata, transform and nodes,
///  3. its leaves, some at a time.
/// Each step reads a piece of the file into a window and looks at all that says how much comes next;
/// only then does OpenVDB get the piece.
///
/// Why this is sound: OpenVDB reads the very bytes that were looked at, from memory, so a file that
/// changes meanwhile cannot deceive it; it reads them in the same order, for all that its reader
/// branches on (versions, flags, masks, types, counts, lengths, the grid's own metadata) is part of
/// the walk; and each length was compared with the bytes that are there and with the place that OpenVDB
/// has for them. What lies in packed values is left to Blosc and zlib, which are told the size of
/// their buffer and keep to it, given that the lengths in a Blosc header are right: those are looked at
/// too. Values are not: any number is a value. Only those of nodes above leaves, which are few, are unpacked here as well: not
/// every byte is a bool, and where OpenVDB cannot unpack the values of such a node, it loses the node's memory.
///
/// Memory: the piece in hand; the largest is a grid's nodes without their values, 64 bytes a leaf. What
/// OpenVDB takes is bounded by what packed bytes can become: 255 times as many by Blosc, and a node of
/// at most 1 MiB for some hundred bytes. Nodes that exceed the machine's memory are refused before
/// OpenVDB takes it. Cost: a copy of the bytes, and some tens of instructions a leaf.

#pragma once

#include "BufferWalk.h"
#include "ByteWindow.h"
#include "GridHead.h"

#include <memory>
#include <streambuf>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

class VdbGuard : public std::streambuf {
public:
    /// @param source     at the start of a `.vdb`; outlives the guard
    /// @param treatment  Keep, if the file is to be opened once more with delayed loading
    explicit VdbGuard(std::streambuf& source, DelayedMetadata treatment = DelayedMetadata::Drop);

    /// @brief Walk on to the end without handing anything on.
    /// @throw openvdb::IoError if the file is truncated or damaged; openvdb::ValueError if the nodes of
    ///        its grids exceed this machine's memory
    void takeAll();

    /// @return whether the file says where its grids are, as delayed loading needs it.
    bool hasOffsets() const { return mFile.hasOffsets; }
    /// @return of the grids up to here, unique in the file.
    const std::vector<std::string>& names() const { return mNames; }

protected:
    /// @throw as takeAll(); whatever the source throws
    int_type underflow() override;
    /// Tells the position, and cannot seek.
    pos_type seekoff(off_type, std::ios_base::seekdir, std::ios_base::openmode) override;

private:
    bool takePiece();
    void takeGrid();
    void endGrid();

    ByteWindow mWindow;
    DelayedMetadata mTreatment;
    bool mStarted = false;
    FileHead mFile;
    GridHead mGrid;
    int32_t mGridsLeft = 0;
    std::vector<std::string> mNames;
    double mNodeBytes = 0;                ///< that OpenVDB takes for the nodes up to here
    std::unique_ptr<BufferWalk> mBuffers; ///< of the present grid; none between grids
};

} // namespace openvdb_spheretree::detail
