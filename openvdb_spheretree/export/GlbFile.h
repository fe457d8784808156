// SPDX-License-Identifier: Apache-2.0
/// @file GlbFile.h
/// @brief The frame of a binary glTF file: views of one buffer, accessors on them, and the two chunks.
/// https://registry.khronos.org/glTF/specs/2.0/glTF-2.0.html

#pragma once

#include "ExportBytes.h"
#include "ExportScene.h"
#include <openvdb_spheretree/store/JsonWriter.h>

#include <cstdint>
#include <functional>
#include <iosfwd>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

/// @throw openvdb::ValueError if a .glb cannot be of that size: its header has 32 bits for it
void requireGlbSize(uint64_t fileBytes);

class GlbFile {
public:
    enum Component { UnsignedInt = 5125, Float = 5126 };

    /// @brief Add an array to the buffer.
    /// @param type   "SCALAR" or "VEC3"
    /// @param count  elements; of 4-byte components
    /// @param put    writes all of them
    /// @return the number of its accessor
    int addArray(const std::string& type, Component component, std::size_t count,
        std::function<void(ExportBytes&)> put);
    /// The same for the corners of triangles; their numbers are accessors' targets.
    int addPoints(
        std::size_t count, const openvdb::BBoxd& box, std::function<void(ExportBytes&)> put);
    int addIndices(std::size_t count, std::function<void(ExportBytes&)> put);

    /// @param writeScenes  writes the members "scenes", "nodes" and "meshes" of the file
    /// @param extension    that they need; may be empty
    /// @throw openvdb::ValueError if the file would be larger than 4 GiB, which it can't
    void write(const std::function<void(JsonWriter&)>& writeScenes, const std::string& extension,
        const ExportSink& out) const;

private:
    enum Target { NoTarget = 0, ArrayBuffer = 34962, ElementArrayBuffer = 34963 };
    struct Array {
        std::string type;
        Component component;
        Target target;
        std::size_t count;
        openvdb::BBoxd box; ///< of points; else empty
        std::function<void(ExportBytes&)> put;

        uint64_t bytes() const { return 4 * uint64_t(count) * (type == "VEC3" ? 3 : 1); }
    };

    std::string json(const std::function<void(JsonWriter&)>& writeScenes,
        const std::string& extension, uint64_t bufferBytes) const;

    std::vector<Array> mArrays;
};

/// Writes the node that all others hang on: it turns what is up to where glTF has it, and makes metres.
/// @param children  numbers of nodes
void writeRootNode(JsonWriter& json, const ExportScene& scene, const std::vector<int>& children);

} // namespace openvdb_spheretree::detail
