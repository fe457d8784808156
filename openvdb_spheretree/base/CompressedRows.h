// SPDX-License-Identifier: Apache-2.0
/// @file CompressedRows.h
/// @brief Lists of integers, one for each of many rows, as compressed sparse rows (CSR): the
/// children of nodes, or their neighbours in a graph. Cost: O(rows + items) to make; 4 bytes an
/// item, 8 a row. Tests: TestCompressedRows.cc.

#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace openvdb_spheretree {

/// One row, for a range-for.
struct NodeSpan {
    const int32_t *first = nullptr, *last = nullptr;

    const int32_t* begin() const { return first; }
    const int32_t* end() const { return last; }
    std::size_t size() const { return std::size_t(last - first); }
    bool empty() const { return first == last; }
    int32_t operator[](std::size_t i) const { return first[i]; }
};

/// Reading is thread-safe.
struct CompressedRows {
    std::vector<int64_t> offsets; ///< of each row in `targets`, and its size at the end
    std::vector<int32_t> targets; ///< of all rows, one after another

    /// @param row  in [0, rowCount())
    NodeSpan operator[](int32_t row) const
    {
        return {targets.data() + offsets[std::size_t(row)],
            targets.data() + offsets[std::size_t(row) + 1]};
    }
    std::size_t rowCount() const { return offsets.empty() ? 0 : offsets.size() - 1; }
};

/// @brief Rows by one counting sort: each keeps the order in which its items come.
/// @param row     row(i), for i in [0, items): which of the @a rows the item is in
/// @param target  target(i): what stands there
template <typename Row, typename Target>
CompressedRows compressedRows(
    std::size_t items, std::size_t rows, const Row& row, const Target& target)
{
    CompressedRows result;
    // The count of row r goes to r + 2. Sums then make r + 1 the begin of row r, and filling the
    // row moves that to its end, which is the begin of row r + 1.
    result.offsets.assign(rows + 2, 0);
    for (std::size_t i = 0; i < items; ++i) ++result.offsets[std::size_t(row(i)) + 2];
    for (std::size_t r = 2; r < result.offsets.size(); ++r) {
        result.offsets[r] += result.offsets[r - 1];
    }
    result.targets.resize(items);
    for (std::size_t i = 0; i < items; ++i) {
        const int64_t place = result.offsets[std::size_t(row(i)) + 1]++;
        result.targets[std::size_t(place)] = target(i);
    }
    result.offsets.pop_back();
    return result;
}

/// @param rowOf  of each item, in [0, rows)
/// @return the indices of the items by their rows, each row in ascending order.
inline CompressedRows compressedRows(const std::vector<int32_t>& rowOf, std::size_t rows)
{
    return compressedRows(
        rowOf.size(), rows, [&](std::size_t i) { return rowOf[i]; },
        [](std::size_t i) { return int32_t(i); });
}

} // namespace openvdb_spheretree
