// SPDX-License-Identifier: Apache-2.0
/// @file QueryTree.h
/// @brief A sphere-tree made ready for questions: collision, distance, points, rays, motion.
///
///     const QueryTree dragon = makeQueryTree(tree);
///     if (collide(dragon, poseA, dragon, poseB).verdict == Verdict::Touching) ...
///
/// It is made in memory in milliseconds, and never stored: the children of a node stand side by side in a
/// block, so that one vector operation tests them all. Some 40 bytes a leaf sphere, all levels
/// included.
///
/// *What answers are about.* Let L be the union of the leaf spheres as files have them (padded, in
/// world units), and O the union of the closed voxel cubes of the object. docs/queries.md has for
/// each question what is certain about L and O, and why; in short:
///
/// - Where holdsObject(), every cube lies in a chain of spheres from the top down to a leaf. No
///   question misses what meets the object: "apart" is certain, a distance is never too large.
/// - Where holdsLeaves(), every sphere holds the leaf spheres below it: all answers are those of L.
///
/// Tests: TestQueryTree.cc.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <cstddef>
#include <cstdint>
#include <memory>

namespace openvdb_spheretree {

namespace detail {
struct QueryData;
}

/// What the spheres above the leaves have to hold.
enum class Exactness {
    /// The object: the tree's own spheres, which of a tight tree with cover=voxels hold voxels. The
    /// fastest questions, and the nearest to the object.
    Object,
    /// The leaf spheres: where the tree's own do not hold them, a new hierarchy is made over its leaves.
    LeafUnion
};

struct QueryTreeSettings {
    Exactness exactness = Exactness::Object;
    /// The level whose spheres are the leaves: a coarser one answers sooner, and holds as much. -1: the finest.
    int level = -1;
    /// The tree is scaled by this about the world's origin: above 0, and finite.
    double scale = 1;
};

/// Immutable; copies share it, and any number of threads may ask at the same time. makeQueryTree() makes it.
class QueryTree {
public:
    /// @param data  not null
    explicit QueryTree(std::shared_ptr<const detail::QueryData> data) : mData(std::move(data)) {}

    int32_t leafCount() const;
    /// @return the id of a leaf's sphere in the sphere-tree that this was made of.
    int32_t nodeId(int32_t leaf) const;
    /// @return the number of the leaf that was made of this node of the sphere-tree.
    /// @throw openvdb::LookupError if no leaf was
    int32_t leafOf(int32_t nodeId) const;

    /// @name A leaf's sphere in world units, before any pose
    /// As questions see it: it holds the stored sphere, and is larger by rounding to floats at most.
    /// @{
    openvdb::Vec3d leafCenter(int32_t leaf) const;
    double leafRadius(int32_t leaf) const;
    /// @}

    /// @name A sphere that holds all others, in world units
    /// @{
    openvdb::Vec3d center() const;
    double radius() const;
    /// @}

    bool holdsObject() const;
    bool holdsLeaves() const;
    /// @return what no point of a leaf sphere is farther than from the object; infinity if that is
    ///         not known. World units.
    double leafReach() const;
    /// @return by how much each leaf sphere must shrink so that it lies in the object; infinity if none
    ///         does for certain. World units.
    double leafInset() const;

    /// @return the bytes that this takes.
    std::size_t bytes() const;
    int32_t blockCount() const;

    const detail::QueryData& data() const { return *mData; }

private:
    std::shared_ptr<const detail::QueryData> mData;
};

/// @brief Makes a tree of queries of @a tree, whose spheres are taken as stored: centers in the
/// world, and `radiusWorld`.
/// @throw openvdb::ValueError for a tree that is empty or damaged; of a norm (its balls are not
///        round); of side=fit (its spheres neither hold the object nor lie in it); a reversible one
///        with Exactness::Object (its levels cover the object, but no sphere holds what is below it); for a
///        scale that is none, or a size that floats cannot square.
/// @throw openvdb::ValueError if there is no such level
/// @note Cost: O(nodes), some milliseconds for 20,000 leaves; a hierarchy that is made anew takes
///       O(n log^2 n) of n leaves. Thread-safe.
QueryTree makeQueryTree(const SphereTree& tree, const QueryTreeSettings& settings = {});
QueryTree makeQueryTree(const SphereTree& tree, Exactness exactness);

} // namespace openvdb_spheretree
