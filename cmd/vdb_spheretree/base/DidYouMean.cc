// SPDX-License-Identifier: Apache-2.0
#include "DidYouMean.h"

#include <algorithm>
#include <numeric>

namespace command {

namespace {

/// Number of characters to insert, delete or replace to turn one word into the other (Levenshtein,
/// one row of the table at a time).
size_t editDistance(const std::string& a, const std::string& b)
{
    std::vector<size_t> row(b.size() + 1);
    std::iota(row.begin(), row.end(), size_t(0));
    for (size_t i = 1; i <= a.size(); ++i) {
        size_t diagonal = row[0];
        row[0] = i;
        for (size_t j = 1; j <= b.size(); ++j) {
            const size_t replaced = diagonal + (a[i - 1] != b[j - 1]);
            diagonal = row[j];
            row[j] = std::min({replaced, row[j] + 1, row[j - 1] + 1});
        }
    }
    return row[b.size()];
}

bool startsWith(const std::string& text, const std::string& prefix)
{
    return text.compare(0, prefix.size(), prefix) == 0;
}

} // namespace

std::string didYouMean(const std::string& word, const std::vector<std::string>& candidates)
{
    constexpr size_t kLongest = 60; // the time goes as the square
    if (word.size() > kLongest) return "";
    std::string near;
    const size_t enough = std::max<size_t>(1, word.size() / 3);
    for (const std::string& candidate : candidates) {
        if (candidate.size() > 2 * kLongest) continue;
        const bool continues = word.size() > 2 && startsWith(candidate, word);
        if (!continues && editDistance(word, candidate) > enough) continue;
        near += (near.empty() ? "" : ", ") + candidate;
    }
    return near.empty() ? "" : " (did you mean " + near + "?)";
}

} // namespace command
