// SPDX-License-Identifier: Apache-2.0
// Points with radii for ParaView: https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html.
// Doubles, raw behind the XML. Each point is a vertex as well, or nothing would be drawn.

#include "ExportBytes.h"
#include "ExportText.h"
#include "ExportWriters.h"

#include <functional>

namespace openvdb_spheretree::detail {

namespace {

/// Its values stand behind the XML, after a count of their bytes.
struct Array {
    std::string attributes;
    uint64_t bytes = 0;
    std::function<void(ExportBytes&, const ExportLevel&, std::size_t)> put; ///< one point's
};

template <typename Get>
Array arrayOf(const char* attributes, std::size_t points, std::size_t pointBytes, const Get& get)
{
    return {attributes, uint64_t(points * pointBytes), get};
}

void declare(ExportText& text, const Array& array, uint64_t& offset)
{
    text << "<DataArray " << array.attributes << " format=\"appended\" offset=\"" << offset
         << "\"/>\n";
    offset += sizeof(uint64_t) + array.bytes;
}

} // namespace

void writeVtp(const std::vector<ExportScene>& samples, const ExportSink& out)
{
    const ExportScene& scene = samples.front();
    const std::size_t count = scene.sphereCount();
    const auto data = {arrayOf("type=\"Float64\" Name=\"radius\"", count, 8,
                           [](ExportBytes& to, const ExportLevel& level, std::size_t i) {
                               to.put(level.radii[i]);
                           }),
        arrayOf("type=\"Int32\" Name=\"level\"", count, 4,
            [](ExportBytes& to, const ExportLevel& level, std::size_t) {
                to.put(int32_t(level.number));
            }),
        arrayOf("type=\"Int32\" Name=\"id\"", count, 4,
            [](ExportBytes& to, const ExportLevel& level, std::size_t i) { to.put(level.ids[i]); }),
        arrayOf("type=\"Int32\" Name=\"parent\"", count, 4,
            [](ExportBytes& to, const ExportLevel& level, std::size_t i) {
                to.put(level.parents[i]);
            })};
    const auto points = arrayOf("type=\"Float64\" NumberOfComponents=\"3\" Name=\"Points\"", count,
        24, [](ExportBytes& to, const ExportLevel& level, std::size_t i) {
            for (int axis = 0; axis < 3; ++axis) to.put(level.centers[i][axis]);
        });
    int64_t next = 0;
    const auto connectivity = arrayOf("type=\"Int64\" Name=\"connectivity\"", count, 8,
        [&](ExportBytes& to, const ExportLevel&, std::size_t) { to.put(next++); });
    const auto offsets = arrayOf("type=\"Int64\" Name=\"offsets\"", count, 8,
        [&](ExportBytes& to, const ExportLevel&, std::size_t) { to.put(++next); });

    ExportText text(out, scene.decimals);
    uint64_t offset = 0;
    text << "<?xml version=\"1.0\"?>\n<VTKFile type=\"PolyData\" version=\"1.0\" "
            "byte_order=\"LittleEndian\" "
            "header_type=\"UInt64\">\n<PolyData>\n<Piece NumberOfPoints=\""
         << count << "\" NumberOfVerts=\"" << count
         << "\" NumberOfLines=\"0\" NumberOfStrips=\"0\" NumberOfPolys=\"0\">\n<PointData "
            "Scalars=\"radius\">\n";
    for (const Array& array : data) declare(text, array, offset);
    text << "</PointData>\n<Points>\n";
    declare(text, points, offset);
    text << "</Points>\n<Verts>\n";
    declare(text, connectivity, offset);
    declare(text, offsets, offset);
    text << "</Verts>\n</Piece>\n</PolyData>\n<AppendedData encoding=\"raw\">\n_";
    text.finish();

    ExportBytes bytes(out);
    const auto putAll = [&](const Array& array) {
        next = 0;
        bytes.put(array.bytes);
        for (const ExportLevel& level : scene.levels) {
            for (std::size_t i = 0; i < level.size(); ++i) array.put(bytes, level, i);
        }
    };
    for (const Array& array : data) putAll(array);
    putAll(points);
    putAll(connectivity);
    putAll(offsets);
    bytes.put(std::string("\n</AppendedData>\n</VTKFile>\n"));
    bytes.finish();
}

} // namespace openvdb_spheretree::detail
