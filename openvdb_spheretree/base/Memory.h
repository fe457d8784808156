// SPDX-License-Identifier: Apache-2.0
/// @file Memory.h
/// @brief How much memory there is, and errors before too much is used.

#pragma once

#include <openvdb/Exceptions.h>

#include <cstdint>
#include <string>

namespace openvdb_spheretree::detail {

/// More memory is needed than there may be.
class MemoryError : public openvdb::ValueError {
public:
    /// @param bytes  that are needed, about
    MemoryError(const std::string& what, double bytes) : ValueError(what), mNeeded(bytes) {}
    double needed() const { return mNeeded; }

private:
    double mNeeded;
};

/// @return the bytes of this machine, or of the container; 0 if they are not known.
double physicalMemory();

/// The part of the machine's memory that labels may take unless the settings say otherwise.
constexpr double kMemoryShare = 0.75;

/// @param memory  bytes, or 0 for kMemoryShare of the machine's
/// @return the bytes; INT64_MAX if the machine's are not known.
int64_t allowedMemory(int64_t memory);

/// @param memory  bytes; 0: all that the machine has
/// @return whether as much is no more than that, or nobody knows what the machine has.
bool isAllowed(double bytes, int64_t memory);

/// @return bytes for messages: as GiB, MiB or KiB with one decimal, rounded up; or down, and then as bytes where they are fewer.
std::string asText(double bytes, bool up = true);

/// @return what to type so that as many bytes are allowed.
std::string asMemoryOption(double bytes);

/// @throw MemoryError if @a leaves leaf nodes need more for their labels than is allowed
void requireAllowed(int64_t leaves, int64_t needed, int64_t allowed);

/// @throw MemoryError if @a leaves leaf nodes at @a bytesPerLeaf are more than this machine's physical memory (where that can be told)
void requireMemory(int64_t leaves, int64_t bytesPerLeaf);

/// @brief The same for anything else.
/// @param what    what needs that much, as the subject (plural) of the message
/// @param remedy  what one can do
void requireMemory(double bytes, const std::string& what, const std::string& remedy);

/// @brief The same within what the settings allow.
/// @param memory  bytes; 0: as much as this machine has
void requireAllowed(
    double bytes, int64_t memory, const std::string& what, const std::string& remedy);

} // namespace openvdb_spheretree::detail
