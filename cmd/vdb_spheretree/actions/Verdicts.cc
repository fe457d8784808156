// SPDX-License-Identifier: Apache-2.0
#include "Verdicts.h"

#include "base/Errors.h"
#include "base/Terminal.h"

#include <algorithm>
#include <cstdint>

namespace command {

using openvdb_spheretree::Verdict;

const char* nameOf(Verdict verdict)
{
    if (verdict == Verdict::Apart) return "apart";
    return verdict == Verdict::Touching ? "touching" : "undecided";
}

std::string summaryOf(const Verdicts& verdicts, const char* noun)
{
    std::string text = counted(int64_t(verdicts.size()), noun);
    const char* separator = ": ";
    for (const Verdict verdict : {Verdict::Apart, Verdict::Touching, Verdict::Undecided}) {
        const int64_t count = std::count(verdicts.begin(), verdicts.end(), verdict);
        if (!count) continue;
        text += separator + withCommas(count) + " " + nameOf(verdict);
        separator = ", ";
    }
    return text;
}

void requireExpected(const ActionCall& call, const Verdicts& verdicts, const char* noun,
    const std::vector<int64_t>& numbers)
{
    if (!call.given("expect")) return;
    const bool expectsApart = call.text("expect") == "apart";
    const Verdict expected = expectsApart ? Verdict::Apart : Verdict::Touching;
    const auto isOther = [&](Verdict verdict) { return verdict != expected; };
    const auto other = std::find_if(verdicts.begin(), verdicts.end(), isOther);
    if (other == verdicts.end()) return;
    const int64_t count = std::count_if(verdicts.begin(), verdicts.end(), isOther);
    const auto place = other - verdicts.begin();
    const int64_t number = numbers.empty() ? place : numbers[std::size_t(place)];
    throw CommandError(kCheckFailed,
        "expect=" + call.text("expect") + " does not hold in " + withCommas(count) + " of "
            + counted(int64_t(verdicts.size()), noun) + ", the first: " + noun + " "
            + std::to_string(number) + " is " + nameOf(*other));
}

} // namespace command
