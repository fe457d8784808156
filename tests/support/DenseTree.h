// SPDX-License-Identifier: Apache-2.0
/// @file DenseTree.h
/// @brief The reversible and the extended tree, written down once more from their definition: sets
/// of voxels, doubles, and labels by NaiveReference.h. Shares no code with the library.
///
/// Frame of level 0: a voxel v of level k is centred at f^k v + (f^k - 1) / 2 + origin. A medial
/// ball of level k becomes a sphere of radius f^k sqrt(radiusSq - 1) + sqrt(dim) (f^k - 1) / 2.
/// Reversible: the medial balls of every level of the OR pyramid. Extended, per level: medial balls
/// of the coarsened voxels; every node's parent is the label of the parent voxel of its centre;
/// balls without children go; the radius is what the leaf balls below need; the level's voxels
/// become those within that radius of a centre, inside the pyramid's box.
///
/// With a norm, lengths are the norm's, in voxels: divided by the cost of a face step. A ball of
/// less than the radius r holds what is within the largest cost below r that steps can add up to.
///
/// For objects of some thousand voxels. Doubles do for these: where a choice could hang on the last
/// digits (see `preferDagParent`), it is made with a margin.

#pragma once

#include "NaiveReference.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace spheretree_test {

enum class DenseReconstruction { Clip, Free, None };

struct DenseSettings {
    bool extended = true;
    int factor = 2;
    int dim = 3;
    bool parentByDag = false;
    bool finalFit = true;
    DenseReconstruction reconstruct = DenseReconstruction::Clip;
    bool paperScale = false;
    Weights norm = {0, 0, 0}; ///< all 0: Euclidean
};

struct DenseNode {
    std::array<double, 3> center; ///< index space
    double radius = 0;            ///< voxels of level 0
    int parent = -1;              ///< index in the next level
    Coord ijk;                    ///< in its level's own grid
    int64_t radiusSq = 0;
};

struct DenseLevel {
    std::vector<DenseNode> nodes;      ///< in the order of ijk
    Voxels voxels;                     ///< the set whose medial balls these are
    std::set<std::pair<int, int>> dag; ///< node of the next level, node of this level
};

/// Builds trees of one object; remembers the labels of voxel sets, which settings share.
class DenseTreeBuilder {
public:
    explicit DenseTreeBuilder(const Voxels& object);

    const Coord& origin() const { return mOrigin; }

    std::vector<DenseLevel> build(const DenseSettings& settings);

private:
    struct Leaf {
        std::array<double, 3> center;
        double radius;
        int ancestor;
    };

    static int floorOf(double x) { return int(std::floor(x)); }
    double scaleOf(int level) const { return std::pow(mSettings.factor, level); }

    /// The voxel of @a level that holds voxel @a v of the level below.
    Coord parentVoxel(const Coord& v, int level) const;

    std::array<double, 3> centerOf(const Coord& v, int level) const;
    bool hasNorm() const { return mSettings.norm[0] > 0; }
    double growthOf(int level) const;
    double radiusOf(int64_t radiusSq, int level) const;
    double closed(int64_t radiusSq) const;
    double distance(const std::array<double, 3>& a, const std::array<double, 3>& b) const;

    const NaiveReference& medial(const std::set<Coord>& voxels);
    static Coord labelOf(const NaiveReference& medial, const Coord& voxel);
    static bool isOn(const NaiveReference& medial, const Coord& voxel);
    DenseLevel allBalls(const NaiveReference& medial, int level) const;
    DenseLevel firstLevel(const NaiveReference& medial);

    /// The voxels of @a level: a parent is on when a child is. Without the clip levels may keep
    /// swelling; there the tree ends at the level at which the object's own pyramid is one voxel.
    std::set<Coord> coarsened(const std::set<Coord>& voxels, int level) const;

    CoordBBox pyramidBox(int level) const;

    /// The nodes of @a level; hangs the nodes below on them.
    DenseLevel nextLevel(DenseLevel& below, int level, const NaiveReference& fine,
        const NaiveReference& coarse) const;

    static std::map<Coord, int> indexByCentre(const DenseLevel& level);

    /// Ball of @a level, node below it: some voxel has the node for its label, its parent the ball.
    std::set<std::pair<int, int>> dagEdges(const DenseLevel& below, int level,
        const NaiveReference& fine, const NaiveReference& coarse,
        const std::map<Coord, int>& ballAt) const;

    /// Among the DAG parents of a node, the one it sticks out of least; of equals the first.
    void preferDagParent(DenseLevel& below, int child, const DenseLevel& balls, int level) const;

    /// Drops the balls that nobody below has for its parent.
    static DenseLevel withChildren(DenseLevel& below, const DenseLevel& balls);

    /// The radii of a new level of an extended tree, and the voxels that they rebuild.
    void fitAndRebuild(
        DenseLevel& nodes, const DenseLevel& below, int level, std::set<Coord>& voxels);

    std::set<Coord> reconstructed(const DenseLevel& nodes, int level) const;

    Coord mOrigin;
    Voxels mObject;
    DenseSettings mSettings;
    std::vector<Leaf> mLeaves;
    std::map<std::pair<std::pair<int, Weights>, std::set<Coord>>, std::unique_ptr<NaiveReference>>
        mMedial;
};

} // namespace spheretree_test
