// SPDX-License-Identifier: Apache-2.0
#include "ConfigFile.h"

#include "Actions.h"
#include "base/Errors.h"
#include "files/FdBuffer.h"
#include "files/InputFile.h"
#include "Plan.h"

#include <openvdb_spheretree/base/TextStream.h>

#include <algorithm>
#include <cstdio>

namespace command {

namespace {

constexpr size_t kLongestFile = 1 << 20; // a device or a pipe may never end
constexpr size_t kMostInAll = 4 << 20;
constexpr size_t kLeastPerFile = 1 << 10; // reading a file takes time, even an empty one

/// Adds the words of a line.
/// @param where  the line, for messages
/// @return whether the next line goes on with it. @throw CommandError (usage) if a quote is not closed
bool addWords(std::string line, const std::string& where, std::vector<std::string>& words)
{
    if (!line.empty() && line.back() == '\r') line.pop_back();
    bool inWord = false;
    char quote = '\0';
    for (size_t i = 0; i < line.size(); ++i) {
        const char c = line[i];
        if (quote) {
            if (c == quote) {
                quote = '\0';
            } else {
                words.back() += c;
            }
            continue;
        }
        if (c == '\\' && i + 1 == line.size()) return true;
        if (c == ' ' || c == '\t' || c == '\r') {
            inWord = false;
            continue;
        }
        if (!inWord && c == '#') break;
        if (!inWord) words.emplace_back();
        inWord = true;
        if (c == '"' || c == '\'') {
            quote = c;
        } else {
            words.back() += c;
        }
    }
    if (quote) throwUsage(where + ": a quote is not closed");
    return false;
}

/// @throw CommandError (input) if the file cannot be read, or is none of people's making
std::string textOf(const std::string& path)
try {
    checkReadable(path);
    const InputFile file(path);
    FdBuffer buffer(file.fd());
    std::string text(kLongestFile + 1, '\0');
    text.resize(size_t(buffer.sgetn(text.data(), std::streamsize(text.size()))));
    if (text.size() > kLongestFile || text.find('\0') != std::string::npos) {
        throwInput(
            "this is no text file, or one of more than " + std::to_string(kLongestFile) + " bytes");
    }
    return text;
} catch (...) {
    rethrowNamed("-config " + path, kInput);
}

/// Such a line of vdb_tool's or of ours says what wrote the file.
bool isProgram(const std::string& word) { return word == "vdb_spheretree" || word == "vdb_tool"; }

} // namespace

std::vector<ConfigLine> readConfigFile(const std::string& path, size_t& bytesInAll)
{
    std::string text = textOf(path);
    bytesInAll += std::max(text.size(), kLeastPerFile);
    if (bytesInAll > kMostInAll) {
        throwUsage("-config " + path
            + ": all files of -config together, each as often as it is named and as "
            + std::to_string(kLeastPerFile) + " bytes at least, may hold "
            + std::to_string(kMostInAll) + " bytes, and with this one they hold more");
    }
    const std::string byteOrderMark = "\xEF\xBB\xBF"; // some editors begin UTF-8 with it
    if (text.compare(0, byteOrderMark.size(), byteOrderMark) == 0) {
        text.erase(0, byteOrderMark.size());
    }
    openvdb_spheretree::detail::TextStream in(text);
    std::vector<ConfigLine> lines;
    ConfigLine whole{1, {}};
    std::string line;
    for (int number = 1; std::getline(in, line); ++number) {
        const std::string where = "-config " + path + ", line " + std::to_string(number);
        if (addWords(line, where, whole.words) && in.peek() != EOF) continue;
        std::vector<std::string>& words = whole.words;
        if (!words.empty() && !(whole.number == 1 && isProgram(words.front()))) {
            if (words.front().empty() || words.front().front() != '-') words.front().insert(0, "-");
            lines.push_back(whole);
        }
        whole = {number + 1, {}};
    }
    return lines;
}

ActionSpec configAction()
{
    ActionSpec action = smallAction(
        "config", "run the actions in a file, one a line, dashes left out or not, # for comments");
    action.alias = "c";
    action.isLiteral = true;
    action.mainOption = "files";
    action.options = {list("files", "", "files of actions")};
    return action; // the parser puts the actions of the files in its place
}

} // namespace command
