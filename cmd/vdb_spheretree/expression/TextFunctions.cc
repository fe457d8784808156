// SPDX-License-Identifier: Apache-2.0
/// @file TextFunctions.cc
/// @brief Texts to texts, and parts of file names.

#include "Functions.h"

#include "base/Errors.h"

#include <openvdb_spheretree/base/Text.h>

#include <algorithm>
#include <cctype>
#include <ctime>
#include <random>

namespace command {

namespace {

using openvdb_spheretree::detail::inQuotes;

Function textToText(
    const std::string& name, const std::string& doc, std::string (*function)(const std::string&))
{
    return {
        name, 1, doc, [function](Evaluation& e) { e.operands.push(function(e.operands.pop())); }};
}

/// @name Parts of the name of a file
/// @{
std::string fileOf(const std::string& path) { return path.substr(path.rfind('/') + 1); }

std::string folderOf(const std::string& path)
{
    const std::size_t slash = path.rfind('/');
    return slash == std::string::npos ? "." : path.substr(0, slash);
}

std::string extensionOf(const std::string& path)
{
    const std::string file = fileOf(path);
    const std::size_t dot = file.rfind('.');
    if (dot == std::string::npos || dot + 1 == file.size()) {
        throwUsage(inQuotes(path) + " has no extension");
    }
    return file.substr(dot + 1);
}

std::string nameOf(const std::string& path)
{
    const std::string file = fileOf(path);
    return file.substr(0, file.rfind('.'));
}

/// Where the digits begin that the name ends in.
std::size_t numberBegin(const std::string& name)
{
    const std::size_t last = name.find_last_not_of("0123456789");
    return last == std::string::npos ? 0 : last + 1;
}

std::string baseOf(const std::string& path)
{
    const std::string name = nameOf(path);
    return name.substr(0, numberBegin(name));
}

std::string numberInName(const std::string& path)
{
    const std::string name = nameOf(path);
    const std::string number = name.substr(numberBegin(name));
    if (number.empty()) throwUsage(inQuotes(path) + " has no number at its end");
    return number;
}
/// @}

std::string inUpperCase(const std::string& text)
{
    std::string upper = text;
    for (char& c : upper) c = char(std::toupper(static_cast<unsigned char>(c)));
    return upper;
}

std::string inLowerCase(const std::string& text)
{
    return openvdb_spheretree::detail::lowerCase(text);
}

/// Grows at most to what Operands allows, times the length of @a by.
std::string replaced(const std::string& text, const std::string& what, const std::string& by)
{
    std::string result;
    for (std::size_t begin = 0; begin <= text.size();) {
        const std::size_t found = what.empty() ? text.npos : text.find(what, begin);
        if (found == text.npos) return result + text.substr(begin);
        result += text.substr(begin, found - begin) + by;
        if (result.size() > Operands::kMostBytes) throwUsage("the text grows too long");
        begin = found + what.size();
    }
    return result;
}

void pad(Evaluation& e)
{
    constexpr int64_t kWidest = 64;
    const int64_t width = e.operands.popWhole();
    if (width < 0 || width > kWidest) {
        throwUsage(
            "a width is 0 to " + std::to_string(kWidest) + ", and not " + std::to_string(width));
    }
    const std::string text = e.operands.pop();
    const std::size_t missing = std::size_t(width) - std::min(std::size_t(width), text.size());
    e.operands.push(std::string(missing, '0') + text);
}

/// Each of the characters of the last operand separates.
void tokenize(Evaluation& e)
{
    const std::string separators = e.operands.pop(), text = e.operands.pop();
    for (std::size_t begin = 0; begin < text.size();) {
        const std::size_t end = std::min(text.find_first_of(separators, begin), text.size());
        if (end > begin) e.operands.push(text.substr(begin, end - begin));
        begin = end + 1;
    }
}

std::string dateNow()
{
    const std::time_t now = std::time(nullptr);
    std::tm local = {};
    localtime_r(&now, &local);
    char text[64];
    return {text, std::strftime(text, sizeof(text), "%a %b %e %H:%M:%S %Y", &local)};
}

std::string randomUuid()
{
    std::random_device random;
    std::uniform_int_distribution<unsigned> digit(0, 15);
    std::string text = "xxxxxxxx-xxxx-4xxx-yxxx-xxxxxxxxxxxx";
    for (char& c : text) {
        if (c == 'x') c = "0123456789abcdef"[digit(random)];
        if (c == 'y') c = "89ab"[digit(random) % 4];
    }
    return text;
}

std::vector<Function> fileNameFunctions()
{
    return {
        textToText("path", "{path/base0123.ext:path} -> path", folderOf),
        textToText("file", "{path/base0123.ext:file} -> base0123.ext", fileOf),
        textToText("name", "{path/base0123.ext:name} -> base0123", nameOf),
        textToText("base", "{path/base0123.ext:base} -> base", baseOf),
        textToText("number", "{path/base0123.ext:number} -> 0123", numberInName),
        textToText("ext", "{path/base0123.ext:ext} -> ext", extensionOf),
    };
}

std::vector<Function> wordFunctions()
{
    return {
        {"pad0", 2, "{12:4:pad0} -> 0012", pad},
        {"append", 2, "{foo:bar:append} -> foobar",
            [](Evaluation& e) {
                const std::string b = e.operands.pop(), a = e.operands.pop();
                e.operands.push(a + b);
            }},
        textToText("upper", "{HeLlO:upper} -> HELLO", inUpperCase),
        textToText("lower", "{HeLlO:lower} -> hello", inLowerCase),
        {"length", 1, "{foo bar:length} -> 7",
            [](Evaluation& e) { e.operands.push(Number(int64_t(e.operands.pop().size()))); }},
        {"replace", 3, "{for bar:a:b:replace} -> for bbr",
            [](Evaluation& e) {
                const std::string by = e.operands.pop(), what = e.operands.pop();
                e.operands.push(replaced(e.operands.pop(), what, by));
            }},
        {"erase", 2, "{foo bar:a:erase} -> foo br",
            [](Evaluation& e) {
                const std::string what = e.operands.pop();
                e.operands.push(replaced(e.operands.pop(), what, ""));
            }},
        {"tokenize", 2, "{foo,bar:,:tokenize:squash} -> foo,bar: a value for each word", tokenize},
        {"match", 2, "{sphere_01.vdb:sphere:match} -> 1: whether the first holds the second",
            [](Evaluation& e) {
                const std::string part = e.operands.pop();
                e.operands.push(e.operands.pop().find(part) != std::string::npos);
            }},
        {"date", 0, "{date} -> Sun Mar 27 19:31:16 2022",
            [](Evaluation& e) { e.operands.push(dateNow()); }},
        {"uuid", 0, "{uuid} -> 821105a2-0e60-4a23-970d-0165e0ad4373, another each time",
            [](Evaluation& e) { e.operands.push(randomUuid()); }},
    };
}

} // namespace

std::vector<Function> textFunctions()
{
    std::vector<Function> all = wordFunctions();
    for (const Function& function : fileNameFunctions()) all.push_back(function);
    return all;
}

} // namespace command
