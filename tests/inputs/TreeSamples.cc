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

openvdb::GridPtrVec gridsOf(const SphereTreeSettings& settings)
{
    const SphereTree tree = buildSphereTree(*sampleObject(), settings);
    openvdb::GridPtrVec grids{toPoints(tree)};
    if (const auto dag = dagToPoints(tree)) grids.push_back(dag);
    if (const auto cuts = cutsToPoints(tree)) grids.push_back(cuts);
    return grids;
}

std::string treeBytes(
    const SphereTreeSettings& settings, uint32_t compression, bool seekable = true)
{
    const openvdb::GridPtrVec grids = gridsOf(settings);
    return vdbBytes({grids.begin(), grids.end()}, compression, seekable);
}

/// A tree without a checksum, as version 0.1 wrote it and strangers may: damage is to be found without.
std::string uncheckedBytes(const SphereTreeSettings& settings)
{
    const openvdb::GridPtrVec grids = gridsOf(settings);
    for (const auto& grid : grids) {
        grid->removeMeta("spheretree_checksum");
        grid->removeMeta("spheretree_checksum_transform");
    }
    return vdbBytes({grids.begin(), grids.end()}, kActive);
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
std::string fitBlosc() { return treeBytes(FitOptions(), kBlosc); }
std::string tightUnchecked() { return uncheckedBytes(tightWithCuts()); }
std::string extendedUnchecked() { return uncheckedBytes(extendedWithDag()); }
std::string reversibleUnchecked() { return uncheckedBytes(ReversibleOptions()); }
std::string fitUnchecked() { return uncheckedBytes(FitOptions()); }

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
        {"fit_blosc", ".vdb", fitBlosc},
        {"tight_unchecked", ".vdb", tightUnchecked},
        {"extended_unchecked", ".vdb", extendedUnchecked},
        {"reversible_unchecked", ".vdb", reversibleUnchecked},
        {"fit_unchecked", ".vdb", fitUnchecked},
    };
    return samples;
}

} // namespace spheretree_test
