// SPDX-License-Identifier: Apache-2.0
/// @file TreeSamples.cc
/// @brief Samples of sphere-trees: every kind, with edges, cuts and tracks, and every codec.

#include "SampleFiles.h"
#include "VdbSamples.h"

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/tree/GivenTree.h>
#include <openvdb_spheretree/tree/SphereTracks.h>

namespace spheretree_test {

namespace {

using namespace openvdb_spheretree;

openvdb::GridPtrVec gridsOf(const SphereTree& tree)
{
    openvdb::GridPtrVec grids{toPoints(tree)};
    if (const auto dag = dagToPoints(tree)) grids.push_back(dag);
    if (const auto cuts = cutsToPoints(tree)) grids.push_back(cuts);
    return grids;
}

openvdb::GridPtrVec gridsOf(const SphereTreeSettings& settings)
{
    return gridsOf(buildSphereTree(*sampleObject(), settings));
}

std::string treeBytes(
    const SphereTreeSettings& settings, uint32_t compression, bool seekable = true)
{
    const openvdb::GridPtrVec grids = gridsOf(settings);
    return vdbBytes({grids.begin(), grids.end()}, compression, seekable);
}

/// A tree without a checksum, as version 0.1 wrote it and strangers may: damage is to be found without.
std::string uncheckedBytes(const openvdb::GridPtrVec& grids)
{
    for (const auto& grid : grids) {
        grid->removeMeta("spheretree_checksum");
        grid->removeMeta("spheretree_checksum_transform");
    }
    return vdbBytes({grids.begin(), grids.end()}, kActive);
}

std::string uncheckedBytes(const SphereTreeSettings& settings)
{
    return uncheckedBytes(gridsOf(settings));
}

std::string uncheckedBytes(const SphereTree& tree) { return uncheckedBytes(gridsOf(tree)); }

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

std::string strictUnchecked()
{
    InnerOptions options;
    options.strict = true;
    options.cuts = true;
    return uncheckedBytes(options);
}

/// The second frame of a sequence: some tracks are those of the first one, in another order.
std::string tracksUnchecked()
{
    SphereTree first = buildSphereTree(*sampleObject()), second = first;
    startTracks(first);
    const auto moved = sampleObject();
    moved->tree().setValueOn(openvdb::Coord(-4, 1, 2));
    second = buildSphereTree(*moved);
    continueTracks(second, first);
    return uncheckedBytes(second);
}

/// With its errors: what a level says of itself.
std::string keptUnchecked()
{
    SphereTree tree = buildSphereTree(*sampleObject());
    computeLevelErrors(tree, *sampleObject());
    return uncheckedBytes(keepLevel(tree, 1));
}

WorldSpheres someSpheres()
{
    WorldSpheres spheres;
    spheres.name = "stones";
    for (int i = 0; i < 9; ++i) {
        spheres.center.emplace_back(0.1 * i - 0.3, 0.07 * (i % 4), 0.3 + 0.05 * (i % 3));
        spheres.radius.push_back(0.1 + 0.02 * i);
    }
    return spheres;
}

std::string givenUnchecked() { return uncheckedBytes(givenTree(someSpheres())); }
std::string givenInObject() { return uncheckedBytes(givenTree(someSpheres(), *sampleObject())); }

/// That of no object.
std::string emptyTree()
{
    SphereTree tree;
    tree.transform = openvdb::math::Transform::createLinearTransform(0.5);
    return vdbBytes({emptyTreeToPoints(tree)}, kActive);
}

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
        {"strict_unchecked", ".vdb", strictUnchecked, true, kOfOneMore},
        {"tracks_unchecked", ".vdb", tracksUnchecked, true, kOfOneMore},
        {"kept_unchecked", ".vdb", keptUnchecked, true, kOfOneMore},
        {"given_unchecked", ".vdb", givenUnchecked, true, kOfOneMore},
        {"given_in_object", ".vdb", givenInObject, true, kOfOneMore},
        {"empty_tree", ".vdb", emptyTree, true, kOfOneMore},
    };
    return samples;
}

} // namespace spheretree_test
