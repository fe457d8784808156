// SPDX-License-Identifier: Apache-2.0
/// @file Query.h
/// @brief Trees made ready for questions, and what answers in arrays share. Shapes and types are made sure of by _query.py
/// and _scene.py.

#pragma once

#include "Call.h"
#include "Tree.h"

#include <openvdb_spheretree/query/Collide.h>
#include <openvdb_spheretree/query/Contact.h>
#include <openvdb_spheretree/query/DigitalLeaves.h>
#include <openvdb_spheretree/query/QueryTree.h>
#include <openvdb_spheretree/query/RigidMotion.h>
#include <openvdb_spheretree/query/RigidTransform.h>

#include <pybind11/numpy.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace binding {

using Doubles = pybind11::array_t<double, pybind11::array::c_style>;
using Ids = pybind11::array_t<int32_t>;

/// A tree made ready, and its digital balls where they are the object.
class Query {
public:
    Query(const TreePtr& tree, const openvdb_spheretree::QueryTreeSettings& settings);

    const openvdb_spheretree::QueryTree& tree() const { return mTree; }
    /// @throw InputError where the object is not known
    const openvdb_spheretree::DigitalLeaves& leaves() const;

private:
    openvdb_spheretree::QueryTree mTree;
    std::optional<openvdb_spheretree::DigitalLeaves> mLeaves;
    std::string mWhyNoLeaves;
};

using QueryPtr = std::shared_ptr<Query>;

inline std::size_t rowCount(const pybind11::array& array) { return std::size_t(array.shape(0)); }

template <typename T>
pybind11::array_t<T> rows(std::size_t count, int columns)
{
    return pybind11::array_t<T>({pybind11::ssize_t(count), pybind11::ssize_t(columns)});
}

template <typename T>
void setRow(T* to, const openvdb::Vec3d& vec)
{
    for (int axis = 0; axis < 3; ++axis) to[axis] = T(vec[axis]);
}

/// Poses as Python has them: matrices of 16 numbers, a row each.
struct [[gnu::visibility("hidden")]] PoseRows
{                     // as all of pybind11 is
    const char* name; ///< of the argument, for messages
    const Doubles& matrices;
    std::size_t bodies = 0; ///< of a scene: rows are of so many, frame by frame

    std::size_t size() const { return rowCount(matrices); }
    /// @return as messages have it: " 3", or " of frame 2, body 1".
    std::string rowName(std::size_t row) const;
    /// @throw InputError naming argument and row if it is no pose
    openvdb_spheretree::RigidTransform at(std::size_t row) const;
};

std::vector<openvdb_spheretree::RigidTransform> posesOf(const PoseRows& rows);

/// @return the screws from pose to pose, a row each.
std::vector<openvdb_spheretree::RigidMotion> motionsOf(
    const PoseRows& starts, const PoseRows& ends);

/// @return -1 for apart, 1 for touching, 0 for undecided.
int8_t numberOf(openvdb_spheretree::Verdict verdict);

/// Where two spheres meet, a question a row: numbers are NaN and ids -1 where none do.
class [[gnu::visibility("hidden")]] ContactRows
{ // as all of pybind11 is
public:
    explicit ContactRows(std::size_t count);

    /// Without the GIL; rows may be set at the same time.
    void set(std::size_t i, const std::optional<openvdb_spheretree::Contact>& contact) const;

    pybind11::array_t<double> distances, points, normals;
    Ids ids;

private:
    double *mDistance, *mPoint, *mNormal;
    int32_t* mId;
};

/// @name The deepest contacts of two bodies: so many are asked for, and so many of these kept
/// A list of one would hold any pair.
/// @{
inline int contactsToAsk(int maxContacts) { return std::max(maxContacts, 2); }
inline void keepDeepest(std::vector<openvdb_spheretree::Contact>& contacts, int maxContacts)
{
    contacts.resize(std::min(contacts.size(), std::size_t(maxContacts)));
}
/// @}

/// @brief Runs @a work that answers @a count questions: a few of them on the calling thread.
void runQuestions(
    const CallSettings& call, std::size_t count, const std::function<void(Interrupter*)>& work);

} // namespace binding
