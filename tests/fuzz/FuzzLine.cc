// SPDX-License-Identifier: Apache-2.0
/// @file FuzzLine.cc
/// @brief Fuzz target: the command line, a word a line of the input. It is parsed and checked, not
/// run.

#include "FuzzTarget.h"

#include <base/Errors.h>
#include <line/ActionParser.h>
#include <session/Session.h>

#include <cstdlib>
#include <filesystem>

namespace {

/// Where a line finds no files, and leaves none.
bool goToEmptyFolder()
{
    std::string folder = (std::filesystem::temp_directory_path() / "spheretree_XXXXXX").string();
    if (!mkdtemp(folder.data())) throw std::runtime_error("cannot make a folder");
    std::filesystem::current_path(folder);
    std::filesystem::remove(folder);
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
    static const bool isThere = goToEmptyFolder();
    const std::string text = spheretree_test::textOf(data, size);
    // No word of a command line holds a zero; and a path may lead to a device that never ends.
    if (!isThere || text.find_first_of(std::string("\0/", 2)) != text.npos) return 0;
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
