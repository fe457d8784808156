// SPDX-License-Identifier: Apache-2.0
/// @file VdbBytes.h
/// @brief A `.vdb` written by hand, number by number: what OpenVDB itself writes no more, or never.

#pragma once

#include <openvdb/version.h>

#include <cstdint>
#include <string>

namespace spheretree_test {

class VdbBytes {
protected:
    template <typename T>
    void put(T value)
    {
        mBytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
    }
    void text(const std::string& text)
    {
        put(uint32_t(text.size()));
        mBytes += text;
    }

    /// All up to the number of grids, which is one: without offsets and metadata.
    /// @param zip  of versions 220 and 221, which say so here
    void fileHead(uint32_t version, uint32_t library, bool zip = false)
    {
        put<int64_t>(openvdb::OPENVDB_MAGIC);
        put(version);
        put(library);
        put<uint32_t>(0);
        put<char>(0); // no offsets
        if (version >= 220 && version < 222) put<char>(zip);
        mBytes += "01234567-89ab-cdef-0123-456789abcdef";
        put<uint32_t>(0); // metadata
        put<int32_t>(1);  // grids
    }
    void descriptorOf(const std::string& name, const std::string& type)
    {
        text(name);
        text(type);
        text("");                                    // no instance
        for (int i = 0; i < 3; ++i) put<int64_t>(0); // offsets
    }
    void unitScale()
    {
        text("ScaleMap");
        for (int i = 0; i < 15; ++i) put<double>(1);
    }

    std::string mBytes;
};

} // namespace spheretree_test
