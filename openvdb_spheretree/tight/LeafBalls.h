// SPDX-License-Identifier: Apache-2.0
/// @file tight/LeafBalls.h
/// @brief Which balls reach into which leaf of the object.

#pragma once

#include "FineBall.h"
#include "SampledObject.h"

#include <openvdb/util/NullInterrupter.h>

#include <cstdint>
#include <vector>

namespace openvdb_spheretree {
namespace tight {

class LeafBalls {
public:
    LeafBalls(const std::vector<FineBall>& balls, const SampleLevel& object,
        openvdb::util::NullInterrupter* interrupter);

    struct Range {
        const int32_t *first, *last;
        const int32_t* begin() const { return first; }
        const int32_t* end() const { return last; }
        std::size_t size() const { return std::size_t(last - first); }
    };
    /// @return ascending.
    Range of(std::size_t leaf) const
    {
        return {mBalls.data() + mBegin[leaf], mBalls.data() + mBegin[leaf + 1]};
    }
    /// @return the most balls that reach into a leaf.
    uint32_t most() const;

private:
    std::vector<std::size_t> mBegin;
    std::vector<int32_t> mBalls;
};

} // namespace tight
} // namespace openvdb_spheretree
