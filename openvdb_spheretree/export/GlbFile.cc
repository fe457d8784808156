// SPDX-License-Identifier: Apache-2.0
#include "GlbFile.h"

#include <openvdb_spheretree/base/Rounding.h>

#include <openvdb/Exceptions.h>

#include <cmath>
#include <limits>
#include <utility>

namespace openvdb_spheretree::detail {

void requireGlbSize(uint64_t fileBytes)
{
    if (fileBytes > std::numeric_limits<uint32_t>::max()) {
        OPENVDB_THROW(openvdb::ValueError,
            "a .glb holds 4 GiB at most, and this one would have "
                << fileBytes << " bytes: choose a coarser level with level= or spheres=");
    }
}

int GlbFile::addArray(const std::string& type, Component component, std::size_t count,
    std::function<void(ExportBytes&)> put)
{
    mArrays.push_back({type, component, NoTarget, count, {}, std::move(put)});
    return int(mArrays.size()) - 1;
}

int GlbFile::addPoints(
    std::size_t count, const openvdb::BBoxd& box, std::function<void(ExportBytes&)> put)
{
    mArrays.push_back({"VEC3", Float, ArrayBuffer, count, box, std::move(put)});
    return int(mArrays.size()) - 1;
}

int GlbFile::addIndices(std::size_t count, std::function<void(ExportBytes&)> put)
{
    mArrays.push_back({"SCALAR", UnsignedInt, ElementArrayBuffer, count, {}, std::move(put)});
    return int(mArrays.size()) - 1;
}

std::string GlbFile::json(const std::function<void(JsonWriter&)>& writeScenes,
    const std::string& extension, uint64_t bufferBytes) const
{
    JsonWriter json;
    json.beginObject();
    json.beginObject("asset");
    json.value("version", "2.0");
    json.value("generator", "vdb_spheretree");
    json.endObject();
    if (!extension.empty()) {
        for (const char* list : {"extensionsUsed", "extensionsRequired"}) {
            json.beginArray(list);
            json.value({}, extension);
            json.endArray();
        }
    }
    writeScenes(json);
    json.beginArray("accessors");
    for (std::size_t i = 0; i < mArrays.size(); ++i) {
        const Array& array = mArrays[i];
        json.beginObject();
        json.value("bufferView", int64_t(i));
        json.value("componentType", int(array.component));
        json.value("count", int64_t(array.count));
        json.value("type", array.type);
        for (const char* end : {"min", "max"}) {
            if (array.box.empty()) break;
            const openvdb::Vec3d corner =
                *end == 'm' && end[1] == 'i' ? array.box.min() : array.box.max();
            json.beginArray(end, /*onOneLine=*/true);
            for (int axis = 0; axis < 3; ++axis) json.value({}, double(float(corner[axis])));
            json.endArray();
        }
        json.endObject();
    }
    json.endArray();
    json.beginArray("bufferViews");
    uint64_t offset = 0;
    for (const Array& array : mArrays) {
        json.beginObject();
        json.value("buffer", 0);
        json.value("byteOffset", int64_t(offset));
        json.value("byteLength", int64_t(array.bytes()));
        if (array.target != NoTarget) json.value("target", int(array.target));
        json.endObject();
        offset += array.bytes();
    }
    json.endArray();
    json.beginArray("buffers");
    json.beginObject();
    json.value("byteLength", int64_t(bufferBytes));
    json.endObject();
    json.endArray();
    json.endObject();
    return json.text();
}

void GlbFile::write(const std::function<void(JsonWriter&)>& writeScenes,
    const std::string& extension, const ExportSink& out) const
{
    uint64_t bufferBytes = 0;
    for (const Array& array : mArrays) bufferBytes += array.bytes();
    std::string text = json(writeScenes, extension, bufferBytes);
    text.resize((text.size() + 3) / 4 * 4, ' ');
    const uint64_t fileBytes = 12 + 8 + text.size() + 8 + bufferBytes;
    requireGlbSize(fileBytes);
    ExportBytes bytes(out);
    bytes.put(std::string("glTF"));
    bytes.put(uint32_t(2));
    bytes.put(uint32_t(fileBytes));
    bytes.put(uint32_t(text.size()));
    bytes.put(std::string("JSON"));
    bytes.put(text);
    bytes.put(uint32_t(bufferBytes));
    bytes.put(std::string("BIN\0", 4));
    for (const Array& array : mArrays) array.put(bytes);
    bytes.finish();
}

void writeRootNode(JsonWriter& json, const ExportScene& scene, const std::vector<int>& children)
{
    json.beginObject();
    json.value("name", scene.name);
    if (scene.up == UpAxis::Z) { // a quarter turn about x
        const double half = std::sqrt(0.5);
        json.beginArray("rotation", /*onOneLine=*/true);
        for (const double part : {-half, 0.0, 0.0, half}) json.value({}, part);
        json.endArray();
    }
    if (scene.metersPerUnit != 1) {
        json.beginArray("scale", /*onOneLine=*/true);
        for (int axis = 0; axis < 3; ++axis) json.value({}, scene.metersPerUnit);
        json.endArray();
    }
    json.beginArray("children", /*onOneLine=*/true);
    for (const int child : children) json.value({}, child);
    json.endArray();
    json.endObject();
}

} // namespace openvdb_spheretree::detail
