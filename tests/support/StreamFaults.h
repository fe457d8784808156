// SPDX-License-Identifier: Apache-2.0
/// @file StreamFaults.h
/// @brief What streams may do to a writer: a locale of other digits, a disk that is full.

#pragma once

#include <algorithm>
#include <locale>
#include <streambuf>

namespace spheretree_test {

/// 1.5 is "1,5" and 1000 is "1.000" here.
struct GermanNumbers : std::numpunct<char> {
    char do_decimal_point() const override { return ','; }
    char do_thousands_sep() const override { return '.'; }
    std::string do_grouping() const override { return "\3"; }
};

/// A disk that is full after some bytes.
class FullDisk : public std::streambuf {
public:
    explicit FullDisk(std::streamsize room) : mRoom(room) {}

protected:
    int_type overflow(int_type c) override { return mRoom-- > 0 ? c : traits_type::eof(); }
    std::streamsize xsputn(const char*, std::streamsize n) override
    {
        const std::streamsize taken = std::min(n, mRoom);
        mRoom -= taken;
        return taken;
    }

private:
    std::streamsize mRoom;
};

} // namespace spheretree_test
