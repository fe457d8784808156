// SPDX-License-Identifier: Apache-2.0
/// @file TestTreeChecksum.cc
/// @brief A stored tree is read whole or refused: every bit of it is flipped once. What the checksum is
/// of, against plain loops; and what may change.

#include <openvdb_spheretree/build/BuildSphereTree.h>
#include <openvdb_spheretree/measure/LevelErrors.h>
#include <openvdb_spheretree/store/SphereTreePoints.h>
#include <openvdb_spheretree/store/TreeChecksum.h>

#include "support/CheckedTrees.h"
#include "support/Messages.h"
#include "support/PointsFiles.h"
#include "support/SampleTrees.h"

#include <openvdb/io/Compression.h>
#include <openvdb/io/Stream.h>
#include <openvdb/points/PointAttribute.h>
#include <openvdb/points/PointGroup.h>

#include <zlib.h>

#include <cstring>
#include <functional>
#include <map>
#include <numeric>
#include <sstream>

namespace {

using namespace openvdb_spheretree;
using namespace spheretree_test;
namespace points = openvdb::points;

/// The grids of a tree.
struct Stored {
    PointDataGrid::Ptr nodes, dag, cuts;

    explicit Stored(const SphereTree& tree)
        : nodes(toPoints(tree)), dag(dagToPoints(tree)), cuts(cutsToPoints(tree))
    {}
    SphereTree tree() const { return fromPoints(*nodes, dag.get(), cuts.get()); }

    std::vector<PointDataGrid::Ptr> grids() const
    {
        std::vector<PointDataGrid::Ptr> all{nodes};
        if (dag) all.push_back(dag);
        if (cuts) all.push_back(cuts);
        return all;
    }
};

/// All of a tree: two are equal if these are.
std::string bytesOfTree(const SphereTree& tree)
{
    std::string bytes;
    for (const PointDataGrid::Ptr& grid : Stored(tree).grids()) bytes += bytesOf(grid);
    return bytes;
}

/// Small trees of each kind.
std::vector<std::pair<const char*, SphereTree>> treesOfEveryKind()
{
    const openvdb::BoolGrid::Ptr object = plusAndDot();
    std::vector<std::pair<const char*, SphereTree>> trees;
    const auto add = [&](const char* name, const SphereTreeSettings& settings) {
        trees.emplace_back(name, buildSphereTree(*object, settings));
        computeLevelErrors(trees.back().second, *object);
    };
    ExtendedOptions extended;
    extended.dag = true;
    add("extended", extended);
    extended.edges = DagEdges::Intersecting;
    extended.center = Center::Miniball;
    add("miniball", extended);
    add("reversible", ReversibleOptions());
    ReversibleOptions norm;
    norm.dist = Distance::chamfer(3, 4, 5);
    add("norm", norm);
    TightOptions tight;
    tight.cuts = true;
    add("tight", tight);
    add("inner", InnerOptions());
    add("fit", FitOptions());
    FitOptions few;
    few.budget.spheres = {4, 2};
    add("tracks", few);
    SphereTree& followed = trees.back().second;
    followed.track.resize(std::size_t(followed.size()));
    std::iota(followed.track.rbegin(), followed.track.rend(), 7);
    followed.nextTrack = 7 + followed.size();
    return trees;
}

/// How often a bit was flipped, and how often that changed nothing.
struct Flips {
    int all = 0, harmless = 0;
};

/// What is flipped now is found, or the tree is what it was.
void expectFoundOrEqual(
    const Stored& stored, const std::string& whole, const std::string& what, Flips& flips)
{
    ++flips.all;
    try {
        const SphereTree tree = stored.tree();
        ASSERT_TRUE(bytesOfTree(tree) == whole) << what << " is changed and was not found";
        ++flips.harmless;
    } catch (const openvdb::Exception&) {}
}

template <typename T, typename Codec = points::NullCodec>
void flipEach(points::AttributeArray& array, const std::function<void(int)>& look)
{
    points::AttributeWriteHandle<T, Codec> handle(array);
    for (openvdb::Index n = 0; n < handle.size(); ++n) {
        const T value = handle.get(n);
        for (std::size_t bit = 0; bit < 8 * sizeof(T); ++bit) {
            unsigned char bytes[sizeof(T)];
            std::memcpy(bytes, &value, sizeof(T));
            bytes[bit / 8] = static_cast<unsigned char>(bytes[bit / 8] ^ 1 << bit % 8);
            T flipped;
            std::memcpy(static_cast<void*>(&flipped), bytes, sizeof(T));
            handle.set(n, flipped);
            look(int(bit));
        }
        handle.set(n, value);
    }
}

void flipEachBit(points::AttributeArray& array, const std::function<void(int)>& look)
{
    const std::string type = array.type().first;
    if (type == "float") return flipEach<float>(array, look);
    if (type == "double") return flipEach<double>(array, look);
    if (type == "int32") return flipEach<int32_t>(array, look);
    if (type == "int64") return flipEach<int64_t>(array, look);
    if (type == "vec3s") return flipEach<openvdb::Vec3f>(array, look);
    if (type == "vec3i") return flipEach<openvdb::Vec3i>(array, look);
    ASSERT_EQ(array.type(), points::GroupAttributeArray::attributeType());
    flipEach<points::GroupType, points::GroupCodec>(array, look);
}

TEST(TreeChecksum, EveryFlippedBitOfEveryAttributeAndGroupIsFound)
{
    for (const auto& [name, tree] : treesOfEveryKind()) {
        SCOPED_TRACE(name);
        const Stored stored(tree);
        const std::string whole = bytesOfTree(tree);
        Flips flips;
        for (const PointDataGrid::Ptr& grid : stored.grids()) {
            for (auto leaf = grid->tree().beginLeaf(); leaf; ++leaf) {
                for (const auto& [attribute, index] : leaf->attributeSet().descriptor().map()) {
                    const std::string what = grid->getName() + ": " + attribute;
                    Flips here;
                    flipEachBit(leaf->attributeArray(index), [&](int bit) {
                        expectFoundOrEqual(
                            stored, whole, what + ", bit " + std::to_string(bit), here);
                    });
                    const bool isGroup = attribute.rfind("__group", 0) == 0;
                    ASSERT_LE(tree.levels.size(), 8u) << "one byte holds all groups";
                    const int unused = isGroup ? 8 - int(tree.levels.size()) : 0; // bits
                    const bool isPlace = attribute == "P"; // signs of zeros; what a voxel absorbs
                    EXPECT_TRUE(isPlace || here.harmless == here.all / 8 * unused) << what;
                    flips.all += here.all;
                    flips.harmless += here.harmless;
                }
            }
        }
        EXPECT_GT(flips.all, 1000);
        EXPECT_LT(flips.harmless, flips.all / 10);
        EXPECT_TRUE(bytesOfTree(stored.tree()) == whole) << "all was put back";
    }
}

/// @return metadata with one bit of its value flipped.
openvdb::Metadata::Ptr flippedMeta(const openvdb::Metadata& meta, std::size_t bit)
{
    std::ostringstream out;
    meta.write(out);
    std::string bytes = out.str();
    constexpr std::size_t kSizeBytes = 4;
    char& byte = bytes[kSizeBytes + bit / 8];
    byte = char(byte ^ 1 << bit % 8);
    std::istringstream in(bytes);
    const openvdb::Metadata::Ptr flipped = openvdb::Metadata::createMetadata(meta.typeName());
    flipped->read(in);
    return flipped;
}

TEST(TreeChecksum, EveryFlippedBitOfMetadataAndItsKeysIsFound)
{
    for (const auto& [name, tree] : treesOfEveryKind()) {
        SCOPED_TRACE(name);
        const Stored stored(tree);
        const std::string whole = bytesOfTree(tree);
        Flips flips;
        for (const PointDataGrid::Ptr& grid : stored.grids()) {
            const openvdb::MetaMap before(*grid);
            for (auto it = before.beginMeta(); it != before.endMeta(); ++it) {
                const std::string key = it->first;
                if (key.rfind("spheretree_", 0) != 0) continue;
                // A bool has one bit: where others are set, the file is refused before.
                const bool isBool =
                    it->second->typeName() == openvdb::BoolMetadata::staticTypeName();
                for (std::size_t bit = 0; bit < (isBool ? 1 : 8 * it->second->size()); ++bit) {
                    grid->insertMeta(key, *flippedMeta(*it->second, bit));
                    expectFoundOrEqual(stored, whole, key + ", bit " + std::to_string(bit), flips);
                }
                for (std::size_t bit = 0; bit < 8 * key.size(); ++bit) {
                    std::string other = key;
                    other[bit / 8] = char(other[bit / 8] ^ 1 << bit % 8);
                    grid->removeMeta(key);
                    grid->insertMeta(other, *it->second);
                    expectFoundOrEqual(stored, whole, key + " is now " + other, flips);
                    grid->removeMeta(other);
                    grid->insertMeta(key, *it->second);
                }
                grid->insertMeta(key, *it->second);
            }
        }
        EXPECT_GT(flips.all, 1000);
        // The key of the transform's checksum, made one of somebody else's.
        EXPECT_LE(flips.harmless, int(stored.grids().size()) * 8 * 11);
    }
}

/// It would be read as any points, and become the object of another tree.
TEST(TreeChecksum, ATreeWhoseFormatIsMissingIsStillOne)
{
    const Stored stored(tightSampleTree());
    stored.nodes->removeMeta("spheretree_format");
    EXPECT_TRUE(isSphereTree(*stored.nodes));
    const std::string message = messageOf<openvdb::ValueError>([&] { fromPoints(*stored.nodes); });
    EXPECT_NE(message.find("is a damaged sphere-tree"), std::string::npos) << message;
}

TEST(TreeChecksum, ACompanionWithADamagedFormatIsNoPoints)
{
    const auto expectDamaged = [](PointDataGrid& grid, const std::string& key) {
        EXPECT_FALSE(isSphereTree(grid)) << key;
        const openvdb::Metadata::Ptr format = grid[key]->copy();
        grid.removeMeta(key);
        EXPECT_FALSE(isSphereTree(grid)) << "without " << key;
        for (const std::size_t at : {std::size_t(0), key.size() / 2, key.size() - 1}) {
            std::string damaged = key;
            damaged[at] ^= 4;
            grid.insertMeta(damaged, *format);
            EXPECT_TRUE(isSphereTree(grid)) << damaged;
            EXPECT_THROW(fromPoints(grid), openvdb::ValueError) << damaged;
            grid.removeMeta(damaged);
        }
        grid.insertMeta(key + "2", *format);
        EXPECT_FALSE(isSphereTree(grid)) << "a key of a later version";
    };
    expectDamaged(*Stored(tightSampleTree()).cuts, "spheretree_cuts_format");
    expectDamaged(*Stored(sampleTree()).dag, "spheretree_dag_format");
}

TEST(TreeChecksum, EveryFlippedBitOfTheTransformIsFound)
{
    for (const SphereTree& tree : {sampleTree(), tightSampleTree()}) {
        const Stored stored(tree);
        for (const PointDataGrid::Ptr& grid : stored.grids()) {
            std::ostringstream out;
            grid->transform().write(out);
            const std::string bytes = out.str();
            const openvdb::math::Transform::Ptr before = grid->transformPtr();
            const std::size_t begin = 4 + before->mapType().size(); // the numbers
            for (std::size_t bit = 8 * begin; bit < 8 * bytes.size(); ++bit) {
                std::string flipped = bytes;
                flipped[bit / 8] = char(flipped[bit / 8] ^ 1 << bit % 8);
                std::istringstream in(flipped);
                openvdb::io::setCurrentVersion(in);
                const auto transform = std::make_shared<openvdb::math::Transform>();
                try {
                    transform->read(in);
                } catch (const openvdb::Exception&) {
                    continue; // OpenVDB finds it
                }
                grid->setTransform(transform);
                EXPECT_THROW(stored.tree(), openvdb::Exception) << grid->getName() << ' ' << bit;
            }
            grid->setTransform(before);
        }
        EXPECT_NO_THROW(stored.tree());
    }
}

template <typename T>
std::string whyChanged(const char* attribute, const T& value)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    damage<T>(*grid, attribute, 4, value);
    return messageOf<openvdb::IoError>([&] { fromPoints(*grid); });
}

TEST(TreeChecksum, TheErrorNamesGridAndPart)
{
    EXPECT_TRUE(mentions(whyChanged<double>("radius", 2.5),
        "point grid 'sample tree' is a damaged sphere-tree: by its checksum it is not as it was "
        "written: 'radius' changed"));
    EXPECT_TRUE(mentions(whyChanged<float>("pscale", 2.5f), "'pscale' changed"));
    EXPECT_TRUE(mentions(whyChanged<int32_t>("radius_sq", 77), "'radius_sq' changed"));
    EXPECT_TRUE(mentions(whyChanged<int64_t>("cover_sq", 77), "'cover_sq' changed"));
    EXPECT_TRUE(mentions(whyChanged<int32_t>("parent", 2), "'parent' changed"));
    EXPECT_TRUE(mentions(whyChanged<openvdb::Vec3i>("ijk", {1, 2, 3}), "'ijk' changed"));
    EXPECT_TRUE(mentions(whyChanged<openvdb::Vec3f>("P", {0, 0, 0}), "'P' changed"));

    const auto whyOf = [](const Stored& stored) {
        return messageOf<openvdb::IoError>([&] { stored.tree(); });
    };
    Stored stored(sampleTree());
    stored.nodes->insertMeta("spheretree_source", openvdb::StringMetadata("bunny"));
    EXPECT_TRUE(mentions(whyOf(stored), "its metadata (keys that start with 'spheretree_')"));
    stored = Stored(sampleTree());
    points::setGroup(stored.nodes->tree(), "level_1", true);
    EXPECT_TRUE(mentions(whyOf(stored), "its groups are not as they were written"));
    stored = Stored(sampleTree());
    points::dropGroup(stored.nodes->tree(), "level_2");
    EXPECT_TRUE(mentions(whyOf(stored), "its groups are not as they were written"));
    SphereTree tree = sampleTree();
    tree.dag.pop_back();
    tree.dag.back().child = 7;
    const PointDataGrid::Ptr other = dagToPoints(tree);
    stored = Stored(sampleTree());
    tree = sampleTree();
    tree.dag.pop_back();
    stored.dag = dagToPoints(tree);
    stored.dag->insertMeta("spheretree_checksum", *(*other)["spheretree_checksum"]);
    EXPECT_TRUE(mentions(whyOf(stored), "damaged Sphere-DAG"));
    EXPECT_TRUE(mentions(whyOf(stored), "'edges' changed"));
}

/// A checksum without its first half would otherwise look like a tree that never had one.
TEST(TreeChecksum, AChecksumThatIsLostIsDamage)
{
    const PointDataGrid::Ptr grid = toPoints(sampleTree());
    grid->removeMeta("spheretree_checksum");
    EXPECT_TRUE(hasChecksum(*grid));
    EXPECT_TRUE(mentions(
        messageOf<openvdb::ValueError>([&] { fromPoints(*grid); }), "'spheretree_checksum'"));
    grid->insertMeta("spheretree_checksum", openvdb::StringMetadata("md5 P=0"));
    EXPECT_TRUE(mentions(messageOf<openvdb::IoError>([&] { fromPoints(*grid); }), "no checksum"));
}

TEST(TreeChecksum, ATreeWithoutOneIsReadAsBefore)
{
    const SphereTree tree = tightSampleTree();
    const Stored stored(tree);
    for (const PointDataGrid::Ptr& grid : stored.grids()) {
        EXPECT_TRUE(hasChecksum(*grid));
        removeChecksum(*grid);
        EXPECT_FALSE(hasChecksum(*grid));
    }
    expectSameTree(stored.tree(), tree);
}

TEST(TreeChecksum, ATreeThatWasMovedOnPurposeIsRead)
{
    SphereTree tree = sampleTree();
    const PointDataGrid::Ptr grid = toPoints(tree);
    grid->transform().postTranslate({1, 2, 3});
    EXPECT_TRUE(mentions(messageOf<openvdb::IoError>([&] { fromPoints(*grid); }),
        "remove the metadata 'spheretree_checksum_transform'"));
    grid->removeMeta("spheretree_checksum_transform");
    EXPECT_EQ(fromPoints(*grid).spheres.center, tree.spheres.center);
}

TEST(TreeChecksum, WhatIsNotOursMayComeAndGo)
{
    const Stored stored(sampleTree());
    stored.nodes->setName("another name");
    for (const PointDataGrid::Ptr& grid : stored.grids()) {
        grid->insertMeta("artist", openvdb::StringMetadata("somebody"));
        grid->insertMeta("global:shot", openvdb::Int32Metadata(7));
        points::appendAttribute<openvdb::Vec3f>(grid->tree(), "Cd", openvdb::Vec3f(1, 0, 0));
        points::appendGroup(grid->tree(), "chosen");
        points::setGroup(grid->tree(), "chosen", true);
    }
    SphereTree renamed = sampleTree();
    renamed.settings.name = "another name";
    expectSameTree(stored.tree(), renamed);
}

/// Metadata, attributes and parts of the checksum that this version does not know.
TEST(TreeChecksum, WhatALaterVersionMayAddIsSkipped)
{
    const SphereTree tree = tightSampleTree();
    const Stored stored(tree);
    for (const PointDataGrid::Ptr& grid : stored.grids()) {
        removeChecksum(*grid);
        grid->insertMeta("spheretree_level_0_roughness", openvdb::DoubleMetadata(0.5));
        points::appendAttribute<float>(grid->tree(), "curvature", 2.0f);
        auto parts = grid == stored.nodes ? detail::nodeChecksums(tree, nullptr)
                                          : detail::cutsChecksums(tree.cuts, nullptr);
        parts.insert(parts.begin(), {"curvature", 0x12345678u});
        detail::writeChecksum(*grid, parts);
    }
    expectSameTree(stored.tree(), tree);
}

/// With each codec, and saved again with each other one.
TEST(TreeChecksum, FilesThatAreSavedAgainStillHaveIt)
{
    using namespace openvdb::io;
    const auto saved = [](const openvdb::GridCPtrVec& grids, uint32_t codec) {
        std::stringstream bytes(std::ios::in | std::ios::out | std::ios::binary);
        Stream out(static_cast<std::ostream&>(bytes));
        out.setCompression(codec);
        out.write(grids);
        openvdb::GridCPtrVec read;
        const openvdb::GridPtrVecPtr stored = Stream(bytes, /*delayLoad=*/false).getGrids();
        read.assign(stored->begin(), stored->end());
        return read;
    };
    const uint32_t codecs[] = {COMPRESS_NONE, COMPRESS_ZIP, COMPRESS_BLOSC | COMPRESS_ACTIVE_MASK,
        COMPRESS_ACTIVE_MASK, COMPRESS_ZIP | COMPRESS_ACTIVE_MASK};
    openvdb::initialize();
    for (const SphereTree& tree : {tightSampleTree(), randomTree(3000, 21)}) {
        for (uint32_t first : codecs) {
            for (uint32_t second : codecs) {
                openvdb::GridCPtrVec grids{toPoints(tree)};
                if (!tree.cuts.empty()) grids.push_back(cutsToPoints(tree));
                grids = saved(saved(grids, first), second);
                const auto at = [&](std::size_t i) {
                    return openvdb::gridConstPtrCast<PointDataGrid>(grids.at(i));
                };
                expectSameTree(
                    fromPoints(*at(0), nullptr, grids.size() > 1 ? at(1).get() : nullptr), tree);
            }
        }
    }
}

/// A zero may have come about with a minus, which a voxel and an offset do not keep.
TEST(TreeChecksum, ZerosHaveNoSign)
{
    SphereTree tree = oneVoxelTree();
    tree.spheres.center[0] = {-0.0, 0.0, -0.0};
    tree.ijk[0] = {8, 0, 0};
    EXPECT_NO_THROW(fromPoints(*toPoints(tree)));
}

// ---- What docs/formats.md says is summed, byte by byte

class Bytes {
public:
    template <typename T>
    void add(const T& value)
    {
        mBytes.append(reinterpret_cast<const char*>(&value), sizeof(T));
    }
    void add(const std::string& text) { mBytes += text; }

    /// As a word of a checksum.
    std::string word(const std::string& part) const
    {
        std::ostringstream text;
        text << ' ' << part << '=' << std::hex;
        text.width(8);
        text.fill('0');
        text << crc32(0, reinterpret_cast<const Bytef*>(mBytes.data()), uInt(mBytes.size()));
        return text.str();
    }

private:
    std::string mBytes;
};

std::string metadataWord(const PointDataGrid& grid)
{
    std::map<std::string, openvdb::Metadata::ConstPtr> sorted;
    for (auto it = grid.beginMeta(); it != grid.endMeta(); ++it) {
        if (it->first.rfind("spheretree_", 0) != 0) continue;
        if (it->first.rfind("spheretree_checksum", 0) == 0) continue;
        sorted[it->first] = it->second;
    }
    Bytes bytes;
    for (const auto& [key, meta] : sorted) {
        std::ostringstream stored;
        meta->write(stored);
        bytes.add(key + '\0' + meta->typeName() + '\0' + stored.str());
    }
    return bytes.word("metadata");
}

TEST(TreeChecksum, IsOfTheBytesThatTheFormatSays)
{
    const SphereTree tree = tightSampleTree();
    const PointDataGrid::Ptr nodes = toPoints(tree), cuts = cutsToPoints(tree);
    const auto spheres = [](const Spheres& all) {
        Bytes centers, stored, parents, radii, squares;
        for (int32_t id = 0; id < all.size(); ++id) {
            for (int axis = 0; axis < 3; ++axis) centers.add<double>(all.center[id][axis]);
            stored.add<float>(all.radiusWorld[id]);
            parents.add<int32_t>(all.parent[id]);
            radii.add<double>(all.radius[id]);
            squares.add<int64_t>(all.coverRadiusSq[id]);
        }
        return "crc32" + centers.word("P") + stored.word("pscale") + parents.word("parent")
            + radii.word("radius") + squares.word("cover_sq");
    };
    Bytes balls, places, first, last;
    for (int32_t id = 0; id < tree.size(); ++id) {
        balls.add<int32_t>(tree.radiusSq[id]);
        for (int axis = 0; axis < 3; ++axis) places.add<int32_t>(tree.ijk[id][axis]);
    }
    for (int32_t id = 0; id < tree.cuts.size(); ++id) {
        first.add<int32_t>(tree.cuts.first[id]);
        last.add<int32_t>(tree.cuts.last[id]);
    }
    const auto text = [](const PointDataGrid& grid, const char* key) { return grid[key]->str(); };
    EXPECT_EQ(text(*nodes, "spheretree_checksum"),
        spheres(tree.spheres) + balls.word("radius_sq") + places.word("ijk")
            + metadataWord(*nodes));
    EXPECT_EQ(text(*cuts, "spheretree_checksum"),
        spheres(tree.cuts.spheres) + first.word("first") + last.word("last") + metadataWord(*cuts));

    const SphereTree withEdges = sampleTree();
    const PointDataGrid::Ptr dag = dagToPoints(withEdges);
    Bytes edges;
    for (const DagEdge& edge : withEdges.dag) {
        edges.add<int32_t>(edge.parent);
        edges.add<int32_t>(edge.child);
    }
    EXPECT_EQ(
        text(*dag, "spheretree_checksum"), "crc32" + edges.word("edges") + metadataWord(*dag));

    Bytes transform; // a scale map: five triples
    ASSERT_EQ(cuts->transform().mapType(), "UniformScaleMap");
    transform.add(uint32_t(15));
    transform.add(std::string("UniformScaleMap"));
    const double scale = cuts->voxelSize()[0];
    for (double number : {scale, scale, 1 / scale, 1 / scale * (1 / scale), 1 / scale / 2}) {
        for (int axis = 0; axis < 3; ++axis) transform.add(number);
    }
    EXPECT_EQ(text(*cuts, "spheretree_checksum_transform"), "crc32" + transform.word("transform"));
}

} // namespace
