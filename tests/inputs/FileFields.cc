// SPDX-License-Identifier: Apache-2.0
#include "FileFields.h"

#include <openvdb/io/Stream.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cstring>
#include <istream>
#include <streambuf>

namespace spheretree_test {

namespace {

/// Reads from memory, and notes what is read.
class NotingBuffer : public std::streambuf {
public:
    explicit NotingBuffer(const std::string& bytes) : mBytes(bytes) {}

    std::vector<Field> fields;

protected:
    std::streamsize xsgetn(char* to, std::streamsize count) override
    {
        const std::size_t left = mBytes.size() - mPosition;
        const std::size_t some = std::min(left, std::size_t(count));
        if (some > 0) fields.push_back({mPosition, some});
        std::memcpy(to, mBytes.data() + mPosition, some);
        mPosition += some;
        return std::streamsize(some);
    }
    /// One character at a time: the header's identifier is read so.
    int_type underflow() override
    {
        return mPosition < mBytes.size() ? traits_type::to_int_type(mBytes[mPosition])
                                         : traits_type::eof();
    }
    int_type uflow() override
    {
        const int_type next = underflow();
        if (next != traits_type::eof()) ++mPosition;
        return next;
    }
    pos_type seekoff(
        off_type offset, std::ios_base::seekdir direction, std::ios_base::openmode) override
    {
        const bool isTell = offset == 0 && direction == std::ios_base::cur;
        return pos_type(isTell ? off_type(mPosition) : off_type(-1));
    }

private:
    const std::string& mBytes;
    std::size_t mPosition = 0;
};

} // namespace

std::vector<Field> vdbFields(const std::string& bytes)
{
    openvdb::initialize();
    NotingBuffer buffer(bytes);
    try {
        std::istream in(&buffer);
        in.exceptions(std::ios::badbit | std::ios::failbit | std::ios::eofbit);
        openvdb::io::Stream(in, /*delayLoad=*/false);
    } catch (const std::exception&) { // the damage
    }
    return buffer.fields;
}

} // namespace spheretree_test
