// SPDX-License-Identifier: Apache-2.0
#include "SampleBytes.h"

#include <stdexcept>

#include <zlib.h>

namespace spheretree_test {

std::string deflated(const std::string& bytes, Deflated stream)
{
    z_stream zlib{};
    if (deflateInit2(
            &zlib, 6, Z_DEFLATED, 15 + (stream == Deflated::Gzip ? 16 : 0), 8, Z_DEFAULT_STRATEGY)
        != Z_OK) {
        throw std::runtime_error("cannot compress a sample");
    }
    std::string out(deflateBound(&zlib, uLong(bytes.size())), '\0');
    zlib.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
    zlib.avail_in = uInt(bytes.size());
    zlib.next_out = reinterpret_cast<Bytef*>(out.data());
    zlib.avail_out = uInt(out.size());
    deflate(&zlib, Z_FINISH);
    out.resize(zlib.total_out);
    deflateEnd(&zlib);
    return out;
}

} // namespace spheretree_test
