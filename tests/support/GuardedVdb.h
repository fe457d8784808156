// SPDX-License-Identifier: Apache-2.0
/// @file GuardedVdb.h
/// @brief For tests of damaged `.vdb`: what the guard says of them. It reads alone, so that a miss is a
/// failed test and no crash; tests/mutation goes on to OpenVDB.

#pragma once

#include <openvdb_spheretree/input/vdb/VdbGuard.h>

#include <openvdb/openvdb.h>

#include <gtest/gtest.h>

#include <cstdint>
#include <cstring>
#include <string>

namespace spheretree_test {

using openvdb_spheretree::detail::DelayedMetadata;

class GuardedVdb : public testing::Test {
protected:
    static void SetUpTestSuite() { openvdb::initialize(); }

    /// @return what the guard says of a file, or nothing if it lets it pass.
    static std::string saidOf(
        const std::string& bytes, DelayedMetadata treatment = DelayedMetadata::Drop);

    static void expectSaid(const std::string& bytes, const std::string& words,
        DelayedMetadata treatment = DelayedMetadata::Drop);
};

/// @return that of vdbSamples() with this name.
openvdb::GridBase::Ptr vdbSample(const std::string& name);
/// @return a `.vdb` of it.
std::string fileOf(const std::string& name, uint32_t compression);

template <typename T>
void overwrite(std::string& bytes, size_t at, T value)
{
    std::memcpy(&bytes.at(at), &value, sizeof(T));
}

/// @return the end of the last place of @a text.
size_t behind(const std::string& bytes, const std::string& text);

} // namespace spheretree_test
