// SPDX-License-Identifier: Apache-2.0
/// @file SampleFiles.h
/// @brief A small sound file of every kind that is read: what mutation tests damage, and what fuzz
/// targets start from.

#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace spheretree_test {

/// Mutants at random: of a kind of file, and of one more of a kind.
constexpr int64_t kOfAKind = 10000, kOfOneMore = 2500;

struct SampleFile {
    std::string name; ///< such as `tight_blosc`; no other sample has it
    /// With its dot. `.cfg` is a file of -config; `.poses`, `.bodies`, `.points` and `.rays` are tables of questions;
    /// `.expression` is the value of an option.
    std::string extension;
    /// Whether a part of the file is never a sound file: true of formats that say how much they hold.
    bool saysItsLength = true;
    std::string bytes;
    int64_t mutants = kOfAKind; ///< at random
};

/// @return the names of all samples.
std::vector<std::string> sampleNames();

/// The same bytes at every call.
SampleFile sampleFile(const std::string& name);

/// A maker of one sample.
struct SampleMaker {
    std::string name, extension;
    std::string (*make)();
    bool saysItsLength = true;
    int64_t mutants = kOfAKind;
};

/// @name Parts of the list
/// @{
const std::vector<SampleMaker>& textSamples();   ///< .vol, meshes, spheres, questions, config files
const std::vector<SampleMaker>& volumeSamples(); ///< other volumes, and pictures
const std::vector<SampleMaker>& sceneSamples();  ///< what assimp reads; none without it
const std::vector<SampleMaker>& treeSamples();   ///< sphere-trees, as `.vdb`
const std::vector<SampleMaker>& gridSamples();   ///< other grids, as `.vdb`
/// @}

} // namespace spheretree_test
