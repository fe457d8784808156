// SPDX-License-Identifier: Apache-2.0
/// @file FuzzLine.cc
/// @brief Fuzz target: the command line, a word a line of the input. It is parsed and checked, not
/// run.

#include "FuzzTarget.h"

#include <base/Errors.h>
#include <line/ActionParser.h>
#include <session/Session.h>

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <stdexcept>

namespace {

/// Where a line finds files of some names, which hold nothing, and makes none that stays.
class Folder {
public:
    Folder()
    {
        std::string path = (std::filesystem::temp_directory_path() / "spheretree_XXXXXX").string();
        if (!mkdtemp(path.data())) throw std::runtime_error("cannot make a folder");
        mPath = path;
        std::filesystem::current_path(mPath);
        std::filesystem::create_directory("d");
        for (const std::string place : {"", "d/"}) {
            for (const char* name : kNames) {
                for (const char* extension : kExtensions) {
                    std::ofstream(place + name + extension);
                }
            }
        }
    }
    ~Folder()
    {
        std::error_code ignored;
        std::filesystem::remove_all(mPath, ignored);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;

private:
    static constexpr const char* kNames[] = {"a", "b", "c", "e", "f", "i", "l", "o", "r", "t",
        "s_0", "s_1", "loop_000", "loop_001", "ring", "flat", "levelset", "tight", "extended",
        "reversible", "inner", "norm", "miniball", "clump"};
    static constexpr const char* kExtensions[] = {
        ".vdb", ".csv", ".json", ".obj", ".ply", ".stl", ".off", ".vol", ".nii.gz", ".raw", ".png"};
    std::filesystem::path mPath;
};

bool isNameLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) || c == '_'; }

/// Whether all files of a line are in its folder or below: a line is tried for whether it could write there, and a path
/// may lead to a device that never ends. Names that are computed are let in where there is no slash alone.
bool staysInFolder(const std::string& text)
{
    if (text.find('/') == text.npos) return true;
    if (text.find('{') != text.npos) return false;
    for (std::size_t i = text.find('/'); i != text.npos; i = text.find('/', i + 1)) {
        const bool isBetween =
            i > 0 && i + 1 < text.size() && isNameLetter(text[i - 1]) && isNameLetter(text[i + 1]);
        if (!isBetween) return false;
    }
    return true;
}

std::vector<std::string> wordsOf(const std::string& text)
{
    std::vector<std::string> words;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t end = std::min(text.find('\n', begin), text.size());
        words.push_back(text.substr(begin, end - begin));
        begin = end + 1;
    }
    return words;
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    static const Folder folder;
    const std::string text = spheretree_test::textOf(data, size);
    // No word of a command line holds a zero.
    if (text.find('\0') != text.npos || !staysInFolder(text)) return 0;
    try {
        const auto line = command::parseLine(wordsOf(text));
        command::scriptOf(line);
        for (const command::ActionCall& call : line) call.typed();
    } catch (const command::CommandError& error) {
        spheretree_test::require(error.code() == command::kUsage || error.code() == command::kInput
                || error.code() == command::kOutput,
            "an exit code that no line should have");
    }
    return 0;
}
