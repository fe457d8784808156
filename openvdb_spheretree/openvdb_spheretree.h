// SPDX-License-Identifier: Apache-2.0
/// @file openvdb_spheretree.h
/// @brief All of the library, as a table of contents: the public headers in the order of the data.
///
/// What reads meshes and volume files, generates objects and draws pictures is a library of its own:
/// openvdb_spheretree_extras.h.

#pragma once

// What long calls throw when they are interrupted, and what empty objects are refused by; the time that stages take,
// and lists by row.
#include "base/CompressedRows.h"
#include "base/EmptyObject.h"
#include "base/Interrupted.h"
#include "base/StageSeconds.h"

// Voxels: what distances and balls are measured in.
#include "voxel/Dimension.h"
#include "voxel/Distance.h"
#include "voxel/MaskTree.h"
#include "voxel/MedialBall.h"

// Triangles, and the voxels that they meet.
#include "mesh/TriangleMesh.h"
#include "mesh/TriangleVoxels.h"

// A grid to the object that it stands for.
#include "input/DelayedValues.h"
#include "input/Object.h"
#include "input/Resample.h"
#include "input/ValueBound.h"

// A mesh to the object of all voxels that its solid meets.
#include "solid/MeshSolid.h"
#include "solid/WindingNumber.h"

// The object to a pyramid of ever coarser ones.
#include "pyramid/BlockModel.h"
#include "pyramid/Closing.h"
#include "pyramid/OrPyramid.h"
#include "pyramid/PyramidModel.h"

// A level's voxels to distances, to medial balls, to spheres inside, and its parts and tunnels.
#include "inner/InnerBalls.h"
#include "medial/DistanceTransform.h"
#include "medial/MedialAxis.h"
#include "topology/LevelTopology.h"
#include "topology/ObjectParts.h"

// What a tree can be asked for, what it is, and the call that builds one.
#include "build/BuildSphereTree.h"
#include "build/MemoryPlan.h"
#include "tree/DagAdjacency.h"
#include "tree/SphereBudget.h"
#include "tree/SphereCuts.h"
#include "tree/SphereTree.h"
#include "tree/SphereTreeSettings.h"
#include "tree/Spheres.h"
#include "tree/Traversal.h"

// A tree's spheres as voxels, its errors, and whether it is right.
#include "check/MeshCheck.h"
#include "check/TreeCheck.h"
#include "measure/LevelErrors.h"
#include "measure/MassProperties.h"
#include "sphere/ExactSphere.h"
#include "sphere/SphereUnion.h"
#include "tree/LevelSpheres.h"
#include "tree/SphereLevelSet.h"

// Questions to a tree.
#include "query/BodyDistance.h"
#include "query/Collide.h"
#include "query/Contact.h"
#include "query/ContinuousCollide.h"
#include "query/DigitalLeaves.h"
#include "query/PointQuery.h"
#include "query/QueryScene.h"
#include "query/QueryTables.h"
#include "query/QueryTree.h"
#include "query/RayQuery.h"
#include "query/RigidMotion.h"
#include "query/RigidTransform.h"
#include "query/SphereDistances.h"

// Spheres that other tools have made.
#include "input/spheres/SphereFile.h"
#include "input/spheres/WorldSpheres.h"
#include "tree/GivenTree.h"
#include "tree/SphereTracks.h"

// To files and back.
#include "store/SphereTreeCsv.h"
#include "store/SphereTreeJson.h"
#include "store/SphereTreePoints.h"
