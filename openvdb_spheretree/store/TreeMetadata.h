// SPDX-License-Identifier: Apache-2.0
/// @file TreeMetadata.h
/// @brief What a sphere-tree knows beside its nodes, as typed metadata of a grid: settings, object,
/// levels, transform. Keys start with `spheretree_`; types are those that OpenVDB registers.

#pragma once

#include <openvdb_spheretree/tree/SphereTree.h>

#include <openvdb/openvdb.h>

#include <string>

namespace openvdb_spheretree::detail {

constexpr char kFormatKey[] = "spheretree_format";
constexpr char kLevelsKey[] = "spheretree_levels"; ///< how many a tree has
constexpr char kEmptyKey[] = "spheretree_empty";   ///< of the points of a tree of nothing
constexpr char kDagFormatKey[] = "spheretree_dag_format";
constexpr char kCutsFormatKey[] = "spheretree_cuts_format";
constexpr char kScaleKey[] = "spheretree_point_scale";

/// Typed access with errors that name the key; T as in openvdb::TypedMetadata<T>.
template <typename T>
void setMeta(openvdb::GridBase& grid, const std::string& key, const T& value)
{
    grid.insertMeta(key, openvdb::TypedMetadata<T>(value));
}

/// @throw openvdb::ValueError if there is no such key, or it is of another type
template <typename T>
T getMeta(const openvdb::GridBase& grid, const std::string& key)
{
    const openvdb::Metadata::ConstPtr meta = grid[key];
    if (!meta) OPENVDB_THROW(openvdb::ValueError, "there is no metadata '" << key << "'");
    if (meta->typeName() != openvdb::TypedMetadata<T>::staticTypeName()) {
        OPENVDB_THROW(openvdb::ValueError,
            "metadata '" << key << "' is of type " << meta->typeName() << ", not "
                         << openvdb::TypedMetadata<T>::staticTypeName());
    }
    return static_cast<const openvdb::TypedMetadata<T>&>(*meta).value();
}

/// @brief Everything of @a tree but its nodes, edges and cuts.
/// @param grid  has its transform: the tree's, scaled by @a scale
void writeTreeMetadata(openvdb::GridBase& grid, const SphereTree& tree, int scale);

/// @return a tree without nodes; level ranges as their counts demand.
/// @throw openvdb::ValueError if anything is missing, of a wrong type or out of range
SphereTree readTreeMetadata(const openvdb::GridBase& grid);

/// @return the scale between the source's voxels and the grid's: a power of two.
int readPointScale(const openvdb::GridBase& grid);

} // namespace openvdb_spheretree::detail
