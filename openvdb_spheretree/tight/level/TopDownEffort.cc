// SPDX-License-Identifier: Apache-2.0
#include "TopDownEffort.h"

#include <algorithm>

namespace openvdb_spheretree::tight {

TopDownEffort topDownEffort(Quality quality, int64_t count, std::size_t leaves)
{
    const bool many = count > 32, large = leaves > 1000;
    const auto fewer = [&](int starts) {
        return std::max(2, int(starts * 8 / std::max<int64_t>(8, count)));
    };
    if (quality == Quality::Fast) {
        return large ? TopDownEffort{fewer(4), {2}, 1, 1}
                     : TopDownEffort{fewer(4), {many ? 8 : 4}, 2, 1};
    }
    if (quality == Quality::Best) return {fewer(96), {2, 4, 8}, fewer(24), 8, 100, 6400};
    if (large && many) return {2, {2, 4}, 2, 2, 16, 640};
    return {fewer(large ? 16 : 48), {2, 4, 8}, fewer(large ? 4 : 12), many ? 2 : 3, 16, 640};
}

} // namespace openvdb_spheretree::tight
