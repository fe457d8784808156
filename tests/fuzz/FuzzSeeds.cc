// SPDX-License-Identifier: Apache-2.0
/// @file FuzzSeeds.cc
/// @brief Writes seeds, a folder a target: `spheretree_fuzz_seeds FOLDER LINES` makes FOLDER/vdb/tight_blosc and so
/// on, of the samples (inputs/SampleFiles.h), and FOLDER/line/lines_1 and so on, of a file of command lines.

#include "inputs/SampleFiles.h"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <sstream>

namespace {

using namespace spheretree_test;

void write(const std::filesystem::path& path, const std::string& bytes)
{
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << bytes;
}

/// @return the target of a kind of file: `niigz` of `.nii.gz`.
std::string targetOf(const std::string& extension)
{
    if (extension == ".cfg") return "config";
    std::string target = extension;
    target.erase(std::remove(target.begin(), target.end(), '.'), target.end());
    return target;
}

void writeSamples(const std::filesystem::path& folder)
{
    for (const std::string& name : sampleNames()) {
        const SampleFile sample = sampleFile(name);
        write(folder / targetOf(sample.extension) / name, sample.bytes);
        if (sample.extension == ".nii") write(folder / "niigz" / name, sample.bytes);
    }
}

/// A word a line, as FuzzLine.cc takes them; `@`, the folder of stored files, is one that is there. The same words are settings
/// where they are.
void writeLines(const std::filesystem::path& folder, std::istream& lines)
{
    int number = 0;
    for (std::string line; std::getline(lines, line);) {
        if (line.empty() || line[0] == '#') continue;
        std::replace(line.begin(), line.end(), '@', 'd');
        std::replace(line.begin(), line.end(), ' ', '\n');
        const std::string name = "lines_" + std::to_string(++number);
        write(folder / "line" / name, line);
        if (line.find("-spheretree") != line.npos) write(folder / "settings" / name, line);
    }
}

} // namespace

int main(int argc, char* argv[])
{
    if (argc != 3) {
        std::cerr << "usage: spheretree_fuzz_seeds FOLDER LINES\n";
        return 2;
    }
    std::ifstream lines(argv[2]);
    if (!lines) {
        std::cerr << "cannot read " << argv[2] << '\n';
        return 3;
    }
    writeSamples(argv[1]);
    writeLines(argv[1], lines);
}
