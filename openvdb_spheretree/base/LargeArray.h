// SPDX-License-Identifier: Apache-2.0
/// @file LargeArray.h
/// @brief Arrays of numbers that start uninitialised, on huge pages where the system has them.
///
/// The transforms write each value once. For arrays of tens of megabytes, getting pages of 4 KiB
/// one by one from the kernel took a quarter of their time.

#pragma once

#include <cstddef>
#include <cstdlib>
#include <memory>
#include <vector>

namespace openvdb_spheretree::detail {

struct FreeLargeArray {
    void operator()(void* data) const { std::free(data); }
};

/// Requests huge pages for memory that has not been written to yet.
void wishHugePages(void* data, std::size_t bytes);

/// Gives an empty vector room, on huge pages where the system has them.
template <typename T>
void reserveLarge(std::vector<T>& vector, std::size_t size)
{
    vector.reserve(size);
    wishHugePages(vector.data(), size * sizeof(T));
}

/// Gives an empty vector @a size values of T(), likewise.
template <typename T>
void resizeLarge(std::vector<T>& vector, std::size_t size)
{
    reserveLarge(vector, size);
    vector.resize(size);
}

template <typename T>
using LargeArray = std::unique_ptr<T[], FreeLargeArray>;

/// @return memory for std::free(), aligned to a cache line or a huge page. @throw std::bad_alloc
void* allocateLarge(std::size_t bytes);

/// @throw std::bad_alloc
template <typename T>
LargeArray<T> makeLargeArray(std::size_t size)
{
    return LargeArray<T>(static_cast<T*>(allocateLarge(size * sizeof(T))));
}

} // namespace openvdb_spheretree::detail
