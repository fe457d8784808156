// SPDX-License-Identifier: Apache-2.0
/// @file TestPackedStore.cc
/// @brief What is put comes back, from memory and from a file; the file has no name, and says what
/// is wrong with its folder.

#include <openvdb_spheretree/slab/PackedStore.h>

#include "support/Messages.h"
#include "support/TemporaryFolder.h"

#include <openvdb/Exceptions.h>
#include <tbb/parallel_for.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <random>

namespace {

using namespace spheretree_test;
using openvdb_spheretree::slab::PackedStore;
using openvdb_spheretree::slab::SpillFile;
using Numbers = std::vector<uint32_t>;

/// Noise, which does not compress, in odd blocks.
Numbers numbersOf(std::size_t block, std::size_t size = 3000)
{
    Numbers numbers(size + block, uint32_t(block));
    std::mt19937 random{uint32_t(block)};
    if (block % 2) std::generate(numbers.begin(), numbers.end(), random);
    return numbers;
}

void put(PackedStore& store, std::size_t block, const Numbers& numbers)
{
    PackedStore::Bytes scratch;
    store.put(block, numbers.data(), numbers.size() * sizeof(uint32_t), sizeof(uint32_t), scratch);
}

Numbers got(const PackedStore& store, std::size_t block, std::size_t size)
{
    PackedStore::Bytes scratch;
    Numbers numbers(size);
    store.get(block, numbers.data(), size * sizeof(uint32_t), scratch);
    return numbers;
}

TEST(PackedStore, GivesBackWhatItTook)
{
    constexpr std::size_t kBlocks = 40;
    for (const int64_t memory : {int64_t(0), int64_t(100000), INT64_MAX}) {
        const TemporaryFolder folder;
        PackedStore store(kBlocks, memory);
        tbb::parallel_for(
            std::size_t(0), kBlocks, [&](std::size_t i) { put(store, i, numbersOf(i)); });
        for (std::size_t i = 0; i < kBlocks; ++i) {
            const Numbers expected = numbersOf(i);
            ASSERT_EQ(got(store, i, expected.size()), expected) << i << ", memory " << memory;
        }
        EXPECT_LE(store.bytesInMemory(), memory);
        EXPECT_EQ(store.bytesInMemory() > 0, memory > 0);
        EXPECT_EQ(store.bytesInFile() > 0, memory < INT64_MAX);
        EXPECT_EQ(folder.openFiles(), memory < INT64_MAX ? 1 : 0);
        EXPECT_EQ(folder.files(), 0) << "it has a name";
        EXPECT_LT(store.bytesInMemory() + store.bytesInFile(), int64_t(kBlocks * 3020 * 4 * 3 / 4))
            << "half of the blocks compress";
    }
}

/// @return a file that is open in the folder, as its number, since it has no name.
std::fstream openFileIn(const TemporaryFolder& folder)
{
    for (const auto& entry : std::filesystem::directory_iterator("/proc/self/fd")) {
        std::error_code gone; // the folder itself is open while it is listed
        const auto target = std::filesystem::read_symlink(entry.path(), gone);
        if (target.string().compare(0, folder.path().size(), folder.path()) != 0) continue;
        return std::fstream(entry.path(), std::ios::binary | std::ios::in | std::ios::out);
    }
    return {};
}

/// The second block, which is whole but shorter, is written over the first one.
TEST(PackedStore, ABlockThatIsNotTheOneThatWasPutIsAnError)
{
    const TemporaryFolder folder;
    PackedStore store(2, 0);
    put(store, 0, numbersOf(1, 3000));
    const int64_t place = store.bytesInFile();
    put(store, 1, numbersOf(3, 1000));
    std::string block(std::size_t(store.bytesInFile() - place), ' ');
    std::fstream file = openFileIn(folder);
    ASSERT_TRUE(file.seekg(place) && file.read(block.data(), std::streamsize(block.size())));
    ASSERT_TRUE(file.seekp(0) && file.write(block.data(), std::streamsize(block.size())).flush());
    EXPECT_TRUE(mentions(
        messageOf<openvdb::IoError>([&] { got(store, 0, 3001); }), "damaged: 4012 bytes in place"));
    EXPECT_EQ(got(store, 1, 1003), numbersOf(3, 1000));
}

TEST(PackedStore, LeavesNoFile)
{
    const TemporaryFolder folder;
    {
        PackedStore store(1, 0);
        put(store, 0, numbersOf(1));
        EXPECT_EQ(folder.openFiles(), 1);
    }
    EXPECT_EQ(folder.openFiles(), 0);
    EXPECT_EQ(folder.files(), 0);
}

TEST(PackedStore, CanMakeItsFileBeforeItIsNeeded)
{
    const TemporaryFolder folder;
    PackedStore store(2, 0);
    store.makeFile();
    EXPECT_EQ(folder.openFiles(), 1);
    put(store, 1, numbersOf(1));
    EXPECT_EQ(folder.openFiles(), 1);
    EXPECT_EQ(got(store, 1, 3001), numbersOf(1));
    const TemporaryDirectory none(folder.path() + "/nowhere");
    EXPECT_THROW(PackedStore(1, 0).makeFile(), openvdb::IoError);
}

TEST(PackedStore, AFolderThatIsNoneIsAnError)
{
    const TemporaryFolder folder;
    std::ofstream(folder.path() + "/file") << "text";
    for (const std::string wrong : {"/nowhere", "/file"}) {
        const TemporaryDirectory directory(folder.path() + wrong);
        PackedStore store(1, 0);
        const std::string why = messageOf<openvdb::IoError>([&] { put(store, 0, numbersOf(1)); });
        EXPECT_TRUE(mentions(why, "'" + folder.path() + wrong + "' cannot be made: "));
        EXPECT_TRUE(mentions(why, "set TMPDIR"));
        EXPECT_TRUE(mentions(why, "memory="));
    }
}

TEST(PackedStore, AFolderThatCannotBeWrittenIsAnError)
{
    const TemporaryFolder folder;
    std::filesystem::permissions(folder.path(), std::filesystem::perms::owner_read);
    constexpr uid_t kNobody = 65534;
    const uid_t user = geteuid();
    const bool isRoot = user == 0; // who can write everywhere
    ASSERT_TRUE(!isRoot || seteuid(kNobody) == 0);
    const std::string why = messageOf<openvdb::IoError>([] { SpillFile(); });
    ASSERT_TRUE(!isRoot || seteuid(user) == 0);
    EXPECT_TRUE(mentions(why, "Permission denied"));
}

TEST(PackedStore, AFullDiskIsAnError)
{
    const TemporaryFolder folder;
    {
        const FileSizeLimit limit(20000);
        PackedStore store(3, 0);
        put(store, 0, numbersOf(1));
        const std::string why = messageOf<openvdb::IoError>([&] { put(store, 1, numbersOf(3)); });
        EXPECT_TRUE(mentions(why, "'" + folder.path() + "' does not take "));
        EXPECT_TRUE(mentions(why, "set TMPDIR"));
        EXPECT_EQ(got(store, 0, 3001), numbersOf(1)) << "what is there stays";
    }
    EXPECT_EQ(folder.openFiles(), 0);
    EXPECT_EQ(folder.files(), 0);
}

/// Of what is to come, the store knows the number of blocks, and what those before took.
TEST(PackedStore, SaysAtTheFirstBlockWhenThereIsNoRoomForAll)
{
    const TemporaryFolder folder;
    PackedStore store(std::size_t(1) << 22, 0);
    EXPECT_TRUE(mentions(
        messageOf<openvdb::IoError>([&] { put(store, 1, numbersOf(1, std::size_t(1) << 23)); }),
        "there is room for"));
    EXPECT_EQ(folder.openFiles(), 1) << "which goes with the store";
}

TEST(SpillFile, KnowsWhetherThereIsRoom)
{
    const TemporaryFolder folder;
    const SpillFile file;
    EXPECT_NO_THROW(file.requireRoom(1));
    const std::string why = messageOf<openvdb::IoError>([&] { file.requireRoom(1e21); });
    EXPECT_TRUE(mentions(why, "needs about 9"));
    EXPECT_TRUE(mentions(why, "there is room for "));
}

TEST(SpillFile, ReadingBeyondItsEndIsAnError)
{
    const TemporaryFolder folder;
    SpillFile file;
    EXPECT_EQ(file.append("abc", 3), 0);
    EXPECT_EQ(file.append("de", 2), 3);
    char text[4] = {};
    file.read(1, text, 3);
    EXPECT_STREQ(text, "bcd");
    EXPECT_TRUE(
        mentions(messageOf<openvdb::IoError>([&] { file.read(3, text, 3); }), "it is too short"));
}

} // namespace
