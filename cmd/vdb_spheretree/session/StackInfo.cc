// SPDX-License-Identifier: Apache-2.0
#include "StackInfo.h"

#include "base/Errors.h"
#include "expression/Number.h"

#include <openvdb_spheretree/base/TextStream.h>
#include <openvdb_spheretree/mesh/TriangleMesh.h>
#include <openvdb_spheretree/voxel/BoxSides.h>
#include <openvdb_spheretree/voxel/UniformVoxels.h>

#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <algorithm>
#include <array>

namespace command {

namespace {

using openvdb::BBoxd;
using openvdb::Vec3d;
using openvdb_spheretree::SphereTree;

/// As vdb_tool has it: no blanks, and six digits.
std::string shown(const Vec3d& point)
{
    openvdb_spheretree::detail::TextStream out;
    out << "[" << point[0] << "," << point[1] << "," << point[2] << "]";
    return out.str();
}

/// As vdb_tool has a Coord.
std::string shown(const std::array<int64_t, 3>& sides)
{
    openvdb_spheretree::detail::TextStream out;
    out << "[" << sides[0] << ", " << sides[1] << ", " << sides[2] << "]";
    return out.str();
}

std::string whole(int64_t number) { return std::to_string(number); }
std::string truth(bool holds) { return holds ? "1" : "0"; }

/// Box, type and numbers of a grid, or of the object that a tree is of.
struct GridFacts {
    openvdb::CoordBBox box; ///< of active voxels
    int64_t voxels = 0;
    const openvdb::math::Transform* transform = nullptr;

    explicit GridFacts(const StackItem& item)
    {
        if (item.tree) {
            box = item.tree->object.bbox;
            voxels = item.tree->object.voxels;
            transform = item.tree->transform.get();
        } else {
            box = item.grid->evalActiveVoxelBoundingBox();
            voxels = int64_t(item.grid->activeVoxelCount());
            transform = &item.grid->transform();
        }
    }

    /// From the center of the first voxel to that of the last.
    BBoxd world() const
    {
        if (voxels == 0) return {Vec3d(0), Vec3d(0)};
        return transform->indexToWorld(BBoxd(box.min().asVec3d(), box.max().asVec3d()));
    }
};

std::string typeOf(const StackItem& item)
{
    if (item.tree) return "sphere-tree";
    return item.grid->isType<openvdb::points::PointDataGrid>() ? "points" : item.grid->valueType();
}

std::string classOf(const StackItem& item)
{
    if (item.tree) return "none";
    switch (item.grid->getGridClass()) {
    case openvdb::GRID_LEVEL_SET: return "ls";
    case openvdb::GRID_FOG_VOLUME: return "fog";
    case openvdb::GRID_STAGGERED: return "staggered";
    default: return "none";
    }
}

std::string boxFact(const std::string& what, const BBoxd& box)
{
    if (what == "BBox") return shown(box.min()) + " " + shown(box.max());
    if (what == "Center") return shown(box.getCenter());
    return textOfReal(0.5 * box.extents().length());
}

const SphereTree& treeOf(const StackItem& item)
{
    if (!item.tree) throwInput(item.description() + " is no sphere-tree");
    return *item.tree;
}

std::string gridFact(const std::string& name, const StackItem& item)
{
    if (name == "gridName") return item.name();
    if (name == "gridType") return typeOf(item);
    if (name == "gridClass") return classOf(item);
    if (name == "isLS") return truth(classOf(item) == "ls");
    if (name == "isFOG") return truth(classOf(item) == "fog");
    if (name == "sphereCount") return whole(treeOf(item).size());
    if (name == "levelCount") return whole(int64_t(treeOf(item).levels.size()));
    const GridFacts facts(item);
    if (name == "voxelSize") return textOfReal(openvdb_spheretree::voxelSizeOf(*facts.transform));
    if (name == "voxelCount") return whole(facts.voxels);
    if (name == "isGridEmpty") return truth(facts.voxels == 0);
    if (name == "gridDim") {
        return shown(openvdb_spheretree::detail::sidesOf(
            facts.voxels == 0 ? openvdb::CoordBBox() : facts.box));
    }
    return boxFact(name.substr(4), facts.world());
}

std::string meshFact(const std::string& name, const openvdb_spheretree::TriangleMesh& mesh)
{
    if (name == "geomName") return mesh.name;
    if (name == "vtxCount") return whole(int64_t(mesh.points.size()));
    if (name == "polyCount") return whole(int64_t(mesh.triangles.size()));
    if (name == "isGeomEmpty") return truth(mesh.points.empty());
    const bool isEmpty = mesh.points.empty();
    return boxFact(
        name.substr(4), isEmpty ? BBoxd(Vec3d(0), Vec3d(0)) : openvdb_spheretree::boxOf(mesh));
}

bool isOfMeshes(const std::string& function)
{
    return function.compare(0, 4, "geom") == 0 || function == "vtxCount" || function == "polyCount"
        || function == "isGeomEmpty";
}

} // namespace

std::string StackInfo::fact(const std::string& function, int64_t age) const
{
    const bool meshes = isOfMeshes(function);
    int64_t at = 0;
    for (auto item = mStack.items().rbegin(); item != mStack.items().rend(); ++item) {
        if (bool((*item)->mesh) != meshes || at++ != age) continue;
        return meshes ? meshFact(function, *(*item)->mesh) : gridFact(function, **item);
    }
    const std::string kind = meshes ? " mesh" : " grid or tree";
    throwInput(std::to_string(age) + ":" + function + " asks for the" + kind + " of age "
        + std::to_string(age) + ", and there " + (at == 1 ? "is " : "are ")
        + (at == 0 ? "none" : std::to_string(at) + " (the newest has age 0)"));
}

std::string StackInfo::count(const std::string& function) const
{
    const bool meshes = function == "geomCount";
    const auto& items = mStack.items();
    return whole(std::count_if(items.begin(), items.end(),
        [&](const auto& item) { return bool(item->mesh) == meshes && !item->written; }));
}

} // namespace command
