// SPDX-License-Identifier: Apache-2.0
#include "CheckedTrees.h"

#include "TightSamples.h"
#include "TreeSettings.h"

#include <openvdb_spheretree/measure/LevelErrors.h>

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>

namespace spheretree_test {

using namespace openvdb_spheretree;
using openvdb::BoolGrid;
using openvdb::Coord;
using openvdb::CoordBBox;

BoolGrid::Ptr plusAndDot()
{
    BoolGrid::Ptr object = BoolGrid::create();
    object->setName("plus");
    object->setTransform(openvdb::math::Transform::createLinearTransform(0.5));
    const Coord offsets[] = {Coord(0, 0, 0), Coord(1, 0, 0), Coord(-1, 0, 0), Coord(0, 1, 0),
        Coord(0, -1, 0), Coord(0, 0, 1), Coord(0, 0, -1)};
    for (const Coord& offset : offsets) object->tree().setValueOn(Coord(2, 2, 2) + offset);
    object->tree().setValueOn(Coord(9, 2, 2));
    return object;
}

void addSphere(SphereTree& tree, const openvdb::Vec3d& center, int64_t coverSq, int32_t parent)
{
    tree.spheres.center.push_back(center);
    tree.spheres.coverRadiusSq.push_back(coverSq);
    tree.spheres.radius.push_back(std::sqrt(double(coverSq)) / 2);
    tree.spheres.parent.push_back(parent);
    const double padded = tree.spheres.radius.back() + tree.settings.paddingVoxels();
    tree.spheres.radiusWorld.push_back(floatAbove(padded * tree.voxelSize() * (1 + 1e-6)));
}

SphereTree plusAndDotTree(const BoolGrid& object, TreeType type)
{
    SphereTree tree;
    setType(tree.settings, type);
    tree.settings.padding = 0;
    tree.transform = object.transform().copy();
    tree.object = {"plus", 8, 2, 0, CoordBBox(Coord(1, 1, 1), Coord(9, 3, 3))};
    // The root must contain the ball of radius 1 around (2, 2, 2) and the point (9, 2, 2).
    addSphere(tree, {5.5, 2, 2}, 81, -1);    // 0: radius 4.5
    addSphere(tree, {2.5, 2.5, 2.5}, 14, 0); // 1: radius 1.87 > 0.87 + 1
    addSphere(tree, {8.5, 2.5, 2.5}, 3, 0);  // 2: radius 0.87
    addSphere(tree, {2, 2, 2}, 4, 1);        // 3: radius 1
    addSphere(tree, {9, 2, 2}, 0, 2);        // 4: a voxel
    tree.ijk = {Coord(1, 0, 0), Coord(1, 1, 1), Coord(4, 1, 1), Coord(2, 2, 2), Coord(9, 2, 2)};
    tree.radiusSq = {1, 1, 1, 2, 1};
    tree.levels.resize(3);
    const int32_t begins[] = {3, 1, 0, 5};
    const int64_t voxels[] = {8, 2, 1};
    for (int k = 0; k < 3; ++k) {
        tree.levels[k].level = k;
        tree.levels[k].begin = begins[k];
        tree.levels[k].end = k == 0 ? 5 : begins[k - 1];
        tree.levels[k].pyramidVoxels = voxels[k];
    }
    for (int k = 0; k < 3; ++k) tree.levels[k].topology = LevelTopology{k < 2 ? 2 : 1, 0, 0};
    tree.dag = {{0, 1}, {0, 2}, {1, 3}, {2, 4}};
    computeLevelErrors(tree, object);
    return tree;
}

std::string sentencesOf(const std::vector<TreeFault>& faults)
{
    std::string text;
    for (const TreeFault& fault : faults) text += fault.sentence + "\n";
    return text;
}

void expectFault(FaultKind kind, const std::function<void(SphereTree&)>& damage,
    const std::string& sentence, TreeType type)
{
    const BoolGrid::Ptr object = plusAndDot();
    SphereTree tree = plusAndDotTree(*object, type);
    damage(tree);
    const std::vector<TreeFault> faults = checkSphereTree(tree, *object);
    const auto found = std::find_if(faults.begin(), faults.end(),
        [&](const TreeFault& fault) { return fault.sentence == sentence; });
    ASSERT_NE(found, faults.end()) << "expected: " << sentence << "\nbut it said:\n"
                                   << sentencesOf(faults);
    EXPECT_EQ(toString(found->kind), toString(kind)) << sentence;
}

} // namespace spheretree_test
