// SPDX-License-Identifier: Apache-2.0
/// @file QueryTables.h
/// @brief Tables (`.csv`) of poses, of one body or of several, of points and rays: what a batch of questions is read from, one a line.
///
/// A header names the columns, in any order and among any others; or there is none, and the number of columns
/// says what they are. Columns are separated by commas, semicolons, tabs or blanks. Empty lines are skipped,
/// and those that begin with '#'.
///
/// | table  | header                                        | without one                             |
/// |--------|-----------------------------------------------|-----------------------------------------|
/// | poses  | x y z                                         | 3: x y z                                |
/// |        | x y z qx qy qz qw                             | 7: x y z qx qy qz qw, as ROS            |
/// |        |                                               | 8: a time before these, as TUM          |
/// |        | x y z rx ry rz, radians: rotationOfAngles()   |                                         |
/// |        | x y z roll pitch yaw, the same three angles   |                                         |
/// |        | m00 m01 m02 m03 m10 ... m23 (m30 ... m33)     | 12 or 16: rows of a matrix, as KITTI    |
/// | bodies | body (frame), and the columns of poses        |                                         |
/// | points | x y z                                         | 3: x y z                                |
/// | rays   | x y z dx dy dz (tnear tfar)                   | 6: origin and direction                 |
///
/// A header names one rotation at most, and no place beside a matrix; one that names none makes poses of moves alone, which is noted if it has
/// columns beside them. A quaternion may be off a length of 1 by 1 %, and is made one; a matrix may be off a rotation by what
/// RigidTransform takes for rounding. Tests: TestQueryTables.cc.

#pragma once

#include "RayQuery.h"
#include "RigidTransform.h"

#include <openvdb/Types.h>

#include <cstdint>
#include <string>
#include <vector>

namespace openvdb_spheretree {

/// Where one of several bodies is.
struct BodyPose {
    int64_t frame =
        0; ///< of the column `frame`, where there is one: lines of a frame stand together, in ascending order
    std::string body; ///< as the line has it, without the blanks and quotes around it; never empty
    RigidTransform pose;
    uint64_t line = 0; ///< of the file, from 1: for messages
};

template <typename Row>
struct QueryTable {
    std::vector<Row> rows;  ///< at least one
    std::string assumption; ///< what was taken for granted, for people; empty if nothing was
};

/// @name Readers
/// @param shownAs  what messages call the file; empty: @a path
/// @throw openvdb::IoError if the file cannot be read, is damaged, or holds no line; the message names the file and
///        the line
/// @{
QueryTable<RigidTransform> readPoseTable(const std::string& path, const std::string& shownAs = {});
QueryTable<BodyPose> readBodyPoseTable(const std::string& path, const std::string& shownAs = {});
QueryTable<openvdb::Vec3d> readPointTable(const std::string& path, const std::string& shownAs = {});
QueryTable<QueryRay> readRayTable(const std::string& path, const std::string& shownAs = {});
/// @}

/// 2 pi, rounded up: angles beyond it were hardly meant as radians.
constexpr double kFullTurn = 6.2832;

/// @return the rotation about the world's x axis, then its y axis, then its z axis, by the right-hand rule; radians. As
///         `-transform rotate=` of vdb_tool turns, and "XYZ" of Houdini and Blender.
openvdb::Mat3d rotationOfAngles(const openvdb::Vec3d& radians);

} // namespace openvdb_spheretree
