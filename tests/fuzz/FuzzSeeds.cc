// SPDX-License-Identifier: Apache-2.0
/// @file FuzzSeeds.cc
/// @brief Writes the samples (inputs/SampleFiles.h) as seeds: `spheretree_fuzz_seeds FOLDER` makes
/// FOLDER/vdb/tight_blosc and so on, a folder a target.

#include "inputs/SampleFiles.h"

#include <filesystem>
#include <fstream>
#include <iostream>

int main(int argc, char* argv[])
{
    using namespace spheretree_test;
    if (argc != 2) {
        std::cerr << "usage: spheretree_fuzz_seeds FOLDER\n";
        return 2;
    }
    for (const std::string& name : sampleNames()) {
        const SampleFile sample = sampleFile(name);
        const bool isConfig = sample.extension == ".cfg";
        const auto folder =
            std::filesystem::path(argv[1]) / (isConfig ? "config" : sample.extension.substr(1));
        std::filesystem::create_directories(folder);
        std::ofstream(folder / name, std::ios::binary) << sample.bytes;
    }
}
