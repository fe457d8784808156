// SPDX-License-Identifier: Apache-2.0
#include "Terminal.h"

#include <cstdio>
#include <cstdlib>
#include <iostream>

#include <sys/ioctl.h>
#include <unistd.h>

namespace command {

std::ostream& standardOutput()
{
    static std::ostream sOut(std::cout.rdbuf());
    return sOut;
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

} // namespace command
