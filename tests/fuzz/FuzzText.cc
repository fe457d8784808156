// SPDX-License-Identifier: Apache-2.0
/// @file FuzzText.cc
/// @brief Fuzz target: numbers, lists of numbers, and texts of strangers made fit for messages.

#include "FuzzTarget.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/tree/SettingsTable.h>
#include <openvdb_spheretree/tree/SphereTreeSettings.h>

#include <base/DidYouMean.h>
#include <line/Action.h>

#include <openvdb/Exceptions.h>

namespace {

using namespace openvdb_spheretree;
using spheretree_test::require;

template <typename Call>
void mayRefuse(const Call& call)
{
    try {
        call();
    } catch (const openvdb::ValueError&) { // as it should be
    }
}

void checkNumbers(const std::string& text)
{
    const auto whole = detail::parseNumber<int64_t>(text);
    if (whole) {
        require(detail::parseNumber<int64_t>(std::to_string(*whole)) == whole, "a whole number");
    }
    detail::parseNumber<uint32_t>(text);
    detail::parseNumber<float>(text);
    if (const auto real = detail::parseNumber<double>(text); real && *real == *real) {
        require(detail::realOf(detail::textOf(*real)) == *real, "a number that changes as text");
    }
    command::parseVector(text);
    mayRefuse([&] { paddingFromString(text); });
    mayRefuse([&] { memoryFromString(text); });
    mayRefuse([&] { closingFromString(text); });
}

void checkMessages(const std::string& text)
{
    constexpr std::size_t kLongest = 20;
    const std::string line = detail::onOneLine(text, kLongest);
    require(line.size() <= kLongest + 3, "a line that is too long");
    for (const char c : line + detail::inQuotes(text)) {
        const auto byte = static_cast<unsigned char>(c);
        require(byte >= 32 && byte != 127, "a control character in a message");
    }
    detail::withoutType(text);
    detail::messageOf(openvdb::IoError(text));
    detail::lowerExtension(text);
    command::didYouMean(text.substr(0, 100), {"read", "write", "spheretree"});
}

} // namespace

int LLVMFuzzerTestOneInput(const uint8_t* data, std::size_t size)
{
    const std::string text = spheretree_test::textOf(data, size);
    checkNumbers(text);
    checkMessages(text);
    return 0;
}
