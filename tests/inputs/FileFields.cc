// SPDX-License-Identifier: Apache-2.0
#include "FileFields.h"

#include <openvdb_spheretree/input/vdb/VdbGuard.h>

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <istream>
#include <sstream>
#include <streambuf>

namespace spheretree_test {

using openvdb_spheretree::detail::DelayedMetadata;
using openvdb_spheretree::detail::VdbGuard;

namespace {

/// Hands on what another buffer has, and notes what is read.
class NotingBuffer : public std::streambuf {
public:
    explicit NotingBuffer(std::streambuf& source) : mSource(source) {}

    std::vector<Field> fields;

protected:
    std::streamsize xsgetn(char* to, std::streamsize count) override
    {
        const std::streamsize some = mSource.sgetn(to, count);
        if (some > 0) fields.push_back({mPosition, std::size_t(some)});
        mPosition += std::size_t(some);
        return some;
    }
    /// One character at a time: the header's identifier is read so.
    int_type underflow() override { return mSource.sgetc(); }
    int_type uflow() override
    {
        ++mPosition;
        return mSource.sbumpc();
    }
    pos_type seekoff(
        off_type offset, std::ios_base::seekdir direction, std::ios_base::openmode) override
    {
        const bool isTell = offset == 0 && direction == std::ios_base::cur;
        return pos_type(isTell ? off_type(mPosition) : off_type(-1));
    }

private:
    std::streambuf& mSource;
    std::size_t mPosition = 0;
};

} // namespace

std::vector<Field> vdbFields(const std::string& bytes)
{
    openvdb::initialize();
    std::stringbuf source(bytes, std::ios::in);
    VdbGuard guard(source, DelayedMetadata::Keep); // it hands on every byte
    NotingBuffer buffer(guard);
    try {
        std::istream in(&buffer);
        in.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
        openvdb::io::Stream(in, /*delayLoad=*/false);
    } catch (const std::exception&) { // the damage
    }
    return buffer.fields;
}

} // namespace spheretree_test
