// SPDX-License-Identifier: Apache-2.0
/// @file TestMutants.cc
/// @brief Every reader against damaged files: parts, flipped bytes, random mutants of a small file of
/// each kind. Each is read whole or refused with a message; none ends its process, hangs, or asks for
/// more memory than kReading. What a tree is used for afterwards may take 1 GiB (ForkServer.h): a few spheres of
/// a damaged one may be large.
///
/// The mutants follow from kSeed and the sample's name, so a failure names one that comes again.
/// With SPHERETREE_MUTANTS=all in the environment, long files are cut and flipped at every byte.

#include "ForkServer.h"

#include "inputs/FileFields.h"
#include "inputs/InputReader.h"
#include "inputs/Mutants.h"
#include "inputs/SampleFiles.h"

#include <gtest/gtest.h>
#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <set>

namespace {

using namespace spheretree_test;

constexpr uint64_t kSeed = 20240607;
constexpr ReadingLimit kReading = {uint64_t(64) << 20, 300};

/// Whether time does not matter.
bool isAllWanted()
{
    const char* const wanted = std::getenv("SPHERETREE_MUTANTS");
    return wanted && wanted == std::string("all");
}

/// Every place in the first 2 KiB, where headers and metadata are; of what follows, as many as keep
/// the time of all samples within minutes.
std::vector<std::size_t> placesIn(std::size_t size, std::size_t most)
{
    constexpr std::size_t kHead = 2048;
    if (isAllWanted()) most = kHead + size;
    std::set<std::size_t> places;
    for (std::size_t i = 0; i < std::min(size, kHead); ++i) places.insert(i);
    const std::size_t step = std::max<std::size_t>(1, size / (most - kHead));
    for (std::size_t i = kHead; i < size; i += step) places.insert(i);
    return {places.begin(), places.end()};
}

/// The same number on every machine, which std::hash is not (FNV-1a).
uint64_t hashOf(const std::string& text)
{
    uint64_t hash = 0xcbf29ce484222325u;
    for (const char c : text) hash = (hash ^ uint8_t(c)) * 0x100000001b3u;
    return hash;
}

/// All mutants of a sample, each by its number.
class MutantList {
public:
    explicit MutantList(SampleFile sample)
        : mSample(std::move(sample)), mCuts(placesIn(mSample.bytes.size(), 2500)),
          mFlips(placesIn(mSample.bytes.size(), 3000))
    {
        if (mSample.extension == ".vdb") mFields = vdbFields(mSample.bytes);
    }

    const SampleFile& sample() const { return mSample; }
    int64_t cuts() const { return int64_t(mCuts.size()); }
    int64_t flips() const { return int64_t(mFlips.size()); }
    int64_t size() const { return cuts() + flips() + mSample.mutants; }

    std::string bytes(int64_t number) const
    {
        Random random(kSeed ^ hashOf(mSample.name) ^ uint64_t(number) * 0x9e3779b97f4a7c15u);
        if (number < cuts()) return mSample.bytes.substr(0, mCuts[std::size_t(number)]);
        if (number < cuts() + flips()) {
            std::string bytes = mSample.bytes;
            bytes[mFlips[std::size_t(number - cuts())]] ^= char(1 + below(255, random));
            return bytes;
        }
        const bool atField = !mFields.empty() && number % 2;
        return atField ? fieldMutant(mSample.bytes, mFields, random)
                       : randomMutant(mSample.bytes, random);
    }

    std::string nameOf(int64_t number) const
    {
        if (number < cuts()) return "cut to " + std::to_string(mCuts[std::size_t(number)]);
        if (number >= cuts() + flips()) return "mutant " + std::to_string(number);
        return "byte " + std::to_string(mFlips[std::size_t(number - cuts())]) + " flipped";
    }

private:
    SampleFile mSample;
    std::vector<std::size_t> mCuts, mFlips;
    std::vector<Field> mFields; ///< none, if it is no .vdb
};

/// Keeps the mutant for whoever looks into it. @return the file's path
std::string keep(const MutantList& mutants, int64_t number)
{
    const auto folder = std::filesystem::temp_directory_path() / "spheretree_findings";
    std::filesystem::create_directories(folder);
    const std::string name = mutants.sample().name + "_" + std::to_string(number);
    const std::string path = (folder / (name + mutants.sample().extension)).string();
    std::ofstream(path, std::ios::binary) << mutants.bytes(number);
    return path;
}

void report(const MutantList& mutants, const ForkedRun& run)
{
    std::cout << mutants.sample().name << " (" << mutants.sample().bytes.size()
              << " bytes): " << run.summary() << '\n';
    constexpr std::size_t kShown = 20;
    for (std::size_t i = 0; i < std::min(run.findings.size(), kShown); ++i) {
        const auto& [number, what] = run.findings[i];
        ADD_FAILURE() << mutants.nameOf(number) << ": " << what << "; kept as "
                      << keep(mutants, number);
    }
    EXPECT_LE(run.findings.size(), kShown) << "the others are not shown";
}

class Mutants : public testing::TestWithParam<std::string> {
protected:
    void SetUp() override { openvdb::initialize(); }

private:
    tbb::global_control mNoThreads{tbb::global_control::max_allowed_parallelism, 1}; // ForkServer.h
};

TEST_P(Mutants, TheSampleItselfIsRead)
{
    const SampleFile sample = sampleFile(GetParam());
    InputReader reader(sample.extension, TreeUses::All);
    EXPECT_TRUE(reader.read(sample.bytes));
    EXPECT_TRUE(reader.read(sample.bytes, /*delayed=*/true));
    EXPECT_EQ(sampleFile(GetParam()).bytes, sample.bytes) << "it must be the same each time";
}

TEST_P(Mutants, AreReadOrRefused)
{
    const MutantList mutants(sampleFile(GetParam()));
    const std::string& extension = mutants.sample().extension;
    const ForkedRun run = runForked(mutants.size(), [&] {
        const auto reader = std::make_shared<InputReader>(extension);
        reader->read(mutants.sample().bytes); // makes what is there once
        reader->limit(kReading);
        return [&, reader](int64_t number) {
            const bool isRead = reader->read(mutants.bytes(number), /*delayed=*/number / 2 % 2);
            if (isRead && number < mutants.cuts() && mutants.sample().saysItsLength) {
                throw std::logic_error("a part of the file was read as if it were whole");
            }
            return isRead;
        };
    });
    report(mutants, run);
}

INSTANTIATE_TEST_SUITE_P(Of, Mutants, testing::ValuesIn(sampleNames()),
    [](const testing::TestParamInfo<std::string>& info) { return info.param; });

} // namespace
