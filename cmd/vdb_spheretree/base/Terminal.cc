// SPDX-License-Identifier: Apache-2.0
#include "Terminal.h"

#include <openvdb_spheretree/base/TextStream.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <iostream>

#include <fcntl.h>
#include <sys/ioctl.h>
#include <unistd.h>

namespace command {

std::ostream& standardOutput()
{
    static std::ostream sOut(std::cout.rdbuf());
    return sOut;
}

void holdStandardStreams()
{
    for (const int file : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        if (fcntl(file, F_GETFD) != -1) continue;
        // The lowest free number is this one: those before it are open. Nothing can be written to
        // it, so that output is not lost without a word. A folder is there without /dev, too.
        if (open("/dev/null", O_RDONLY) < 0) open("/", O_RDONLY);
    }
}

void divertLibraries()
{
    standardOutput();
    std::cout.rdbuf(std::cerr.rdbuf());
}

bool isTerminal(const std::ostream& stream)
{
    if (&stream == &standardOutput()) return isatty(STDOUT_FILENO);
    if (&stream == &std::cerr) return isatty(STDERR_FILENO);
    return false;
}

std::size_t terminalColumns(const std::ostream& stream)
{
    if (!isTerminal(stream)) return 0;
    winsize size = {};
    const int file = &stream == &std::cerr ? STDERR_FILENO : STDOUT_FILENO;
    return ioctl(file, TIOCGWINSZ, &size) == 0 ? size.ws_col : 0;
}

size_t columnsOf(const std::string& text)
{
    size_t columns = 0;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0x80) ++columns;
        else if (byte >= 0xc0) columns += 2; // the first byte of a character
    }
    return columns;
}

std::string brokenAt(const std::string& text, size_t columns)
{
    if (columns == 0) return text;
    openvdb_spheretree::detail::TextStream lines(text);
    std::string result, line;
    while (std::getline(lines, line)) {
        while (columnsOf(line) > columns) {
            size_t fits = line.size();
            while (columnsOf(line.substr(0, fits)) > columns) --fits;
            const size_t blank = line.rfind(' ', fits);
            if (blank == line.npos || line.find_first_not_of(' ') > blank) break;
            result += line.substr(0, blank) + '\n';
            line = "    " + line.substr(blank + 1);
        }
        result += line + '\n';
    }
    return result;
}

std::string cutToColumns(const std::string& text, size_t columns)
{
    if (columnsOf(text) <= columns) return text;
    const std::string dots(std::min<size_t>(columns, 3), '.');
    std::string start;
    for (size_t begin = 0; begin < text.size();) {
        size_t end = begin + 1;
        while (end < text.size() && (text[end] & 0xc0) == 0x80) ++end;
        const std::string longer = start + text.substr(begin, end - begin);
        if (columnsOf(longer) + dots.size() > columns) break;
        start = longer;
        begin = end;
    }
    return start + dots;
}

std::string coloured(const std::ostream& stream, Colour colour, const std::string& text)
{
    const char* const noColour = std::getenv("NO_COLOR");
    if (!isTerminal(stream) || (noColour && *noColour)) return text;
    const char* const codes[] = {"31", "32", "33", "1"}; // in the order of Colour
    return "\033[" + std::string(codes[int(colour)]) + "m" + text + "\033[0m";
}

std::string prettySeconds(double seconds)
{
    char text[32];
    if (seconds < 1) {
        std::snprintf(text, sizeof(text), "%.1f ms", 1e3 * seconds);
    } else {
        std::snprintf(text, sizeof(text), "%.2f s", seconds);
    }
    return text;
}

std::string withCommas(long long number)
{
    std::string digits = std::to_string(number);
    const int first = number < 0 ? 1 : 0;
    for (int i = int(digits.size()) - 3; i > first; i -= 3) digits.insert(size_t(i), ",");
    return digits;
}

std::string counted(long long number, const std::string& noun)
{
    return withCommas(number) + " " + noun + (number == 1 ? "" : "s");
}

} // namespace command
