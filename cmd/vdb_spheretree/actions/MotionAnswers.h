// SPDX-License-Identifier: Apache-2.0
/// @file MotionAnswers.h
/// @brief -collide motion=1: when the second tree first touches the first one on its way from pose to pose. And what this
/// shares with scenes.

#pragma once

#include "PairQuestion.h"

#include <openvdb_spheretree/query/Collide.h>
#include <openvdb_spheretree/query/ContinuousCollide.h>

namespace command {

/// @throw CommandError (usage)
void checkMotion(const ActionCall& call);

openvdb_spheretree::ContinuousCollisionRequest motionRequest(const ActionCall& call);

openvdb_spheretree::Verdict verdictOf(const openvdb_spheretree::ContinuousCollisionResult& result);
/// @return the columns from `spheres` on.
Cells motionCells(const openvdb_spheretree::ContinuousCollisionResult& result, double unit);

/// @brief Ask, and give the answers: one for each way from a pose of the file to the next, or for that from where the tree
/// is to the pose that is typed.
/// @throw CommandError (input, output or check failed)
void giveMotionAnswers(const ActionCall& call, Session& session, const PairQuestion& question);

} // namespace command
