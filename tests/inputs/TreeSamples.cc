// SPDX-License-Identifier: Apache-2.0
/// @file TreeSamples.cc
/// @brief Samples of sphere-trees: every kind, with edges and cuts, and every codec.

#include "SampleFiles.h"
#include "VdbSamples.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>

namespace spheretree_test {

namespace {

using namespace openvdb_spheretree;

std::string treeBytes(
    const SphereTreeSettings& settings, uint32_t compression, bool seekable = true)
{
    const SphereTree tree = buildSphereTree(*sampleObject(), settings);
    openvdb::GridCPtrVec grids{toPoints(tree)};
    if (const auto dag = dagToPoints(tree)) grids.push_back(dag);
    if (const auto cuts = cutsToPoints(tree)) grids.push_back(cuts);
    return vdbBytes(grids, compression, seekable);
}

SphereTreeSettings tightWithCuts()
{
    TightOptions options;
    options.cuts = true;
    return options;
}

SphereTreeSettings extendedWithDag()
{
    ExtendedOptions options;
    options.dag = true;
    return options;
}

std::string tightBlosc() { return treeBytes(tightWithCuts(), kBlosc); }
std::string tightZip() { return treeBytes(tightWithCuts(), kZip); }
std::string tightActive() { return treeBytes(tightWithCuts(), kActive); }
std::string tightNone() { return treeBytes(tightWithCuts(), kNone); }
std::string tightPiped() { return treeBytes(tightWithCuts(), kBlosc, false); }
std::string extendedBlosc() { return treeBytes(extendedWithDag(), kBlosc); }
std::string extendedActive() { return treeBytes(extendedWithDag(), kActive); }
std::string reversibleBlosc() { return treeBytes(ReversibleOptions(), kBlosc); }
std::string innerBlosc() { return treeBytes(InnerOptions(), kBlosc); }

} // namespace

const std::vector<SampleMaker>& treeSamples()
{
    static const std::vector<SampleMaker> samples = {
        {"tight_blosc", ".vdb", tightBlosc},
        {"tight_zip", ".vdb", tightZip},
        {"tight_active", ".vdb", tightActive},
        {"tight_none", ".vdb", tightNone},
        {"tight_piped", ".vdb", tightPiped},
        {"extended_blosc", ".vdb", extendedBlosc},
        {"extended_active", ".vdb", extendedActive},
        {"reversible_blosc", ".vdb", reversibleBlosc},
        {"inner_blosc", ".vdb", innerBlosc},
    };
    return samples;
}

} // namespace spheretree_test
