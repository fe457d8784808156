// SPDX-License-Identifier: Apache-2.0
/// @file detail/TreeCheckReport.h
/// @brief What the checks of a sphere-tree share: what is checked, and the sentences for what
/// failed.

#pragma once

#include "../SphereTree.h"

#include <openvdb/openvdb.h>
#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <sstream>
#include <string>
#include <vector>

namespace openvdb_spheretree {
namespace detail {

struct TreeCheck {
    const SphereTree& tree;
    const openvdb::BoolGrid& object;
    const openvdb::MaskTree& mask; ///< the object's topology
    openvdb::CoordBBox box;        ///< of its voxels
    openvdb::util::NullInterrupter* interrupter;
    std::vector<std::string> failures;

    template <typename... Parts>
    void fail(const Parts&... parts)
    {
        std::ostringstream sentence;
        (sentence << ... << parts);
        failures.push_back(sentence.str());
    }
};

/// Nodes that break a rule: how many, and the first.
class Offenders {
public:
    void add(int32_t id)
    {
        if (mCount++ == 0) mFirst = id;
    }
    explicit operator bool() const { return mCount > 0; }
    friend std::ostream& operator<<(std::ostream& out, const Offenders& o)
    {
        return out << o.mCount << (o.mCount == 1 ? " node" : " nodes") << " (first: id " << o.mFirst
                   << ')';
    }

private:
    int64_t mCount = 0;
    int32_t mFirst = -1;
};

/// Level 0's digital balls are the object; those of other levels have the recorded volume.
void checkDigitalBalls(TreeCheck& check);

/// No level misses a voxel of the object, in exact radii nor in stored ones.
void checkCoverage(TreeCheck& check);

} // namespace detail
} // namespace openvdb_spheretree
