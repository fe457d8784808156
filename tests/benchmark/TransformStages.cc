// SPDX-License-Identifier: Apache-2.0
#include "TransformStages.h"

#include <openvdb_spheretree/medial/DistanceMap.h>
#include <openvdb_spheretree/slab/LabelStream.h>
#include <openvdb_spheretree/topology/LevelTopology.h>

#include <benchmark/benchmark.h>

#include <cstdint>
#include <memory>
#include <vector>

namespace spheretree_benchmark {

namespace {

namespace st = openvdb_spheretree;

/// @return a stage without balls.
template <typename Function>
Work plain(Function function)
{
    return [function] {
        benchmark::DoNotOptimize(function());
        return int64_t(0);
    };
}

Work objectOf(const InputPtr& in)
{
    return plain([source = in->object.makeGrid()] { return st::objectOf(*source); });
}

Work leafLayout(const InputPtr& in)
{
    return plain([in] { return st::LeafLayout(in->mask); });
}

Work distances(const InputPtr& in)
{
    return plain([in] { return st::distanceTransform(in->layout); });
}

Work distancesInPlace(const InputPtr& in)
{
    // Kept from call to call, as what the plain copy writes to: no fresh pages.
    auto values = std::make_shared<std::vector<int32_t>>(
        std::size_t(in->layout.leafCount()) * st::kLeafVoxels);
    return plain([in, values] { return st::distanceTransform(in->layout, values->data()); });
}

Work labelStream(const InputPtr& in)
{
    return plain([in] { return st::slab::LabelStream(in->layout, 3).run(nullptr); });
}

Work labelsKept(const InputPtr& in)
{
    return plain([in] {
        st::detail::LabelOffsets offsets;
        st::slab::LabelStream stream(in->layout, 3);
        stream.keepOffsets(offsets);
        stream.run(nullptr);
        return offsets;
    });
}

Work topology(const InputPtr& in)
{
    return plain([in] { return st::levelTopology(in->layout); });
}

} // namespace

std::vector<BenchmarkStage> transformStages()
{
    return {{"object-mask", objectOf, {}}, {"layout", leafLayout, {}}, {"distance", distances, {}},
        {"distance-int32", distancesInPlace, {}}, {"distance+power+medial", labelStream, {}},
        {"labels-kept", labelsKept, {}}, {"topology", topology, {}}};
}

} // namespace spheretree_benchmark
