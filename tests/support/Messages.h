// SPDX-License-Identifier: Apache-2.0
/// @file Messages.h
/// @brief For tests of error messages: what was thrown, and whether it says enough.

#pragma once

#include <gtest/gtest.h>

#include <exception>
#include <string>

namespace spheretree_test {

/// What the call throws as an E; fails the test if it throws nothing or something else.
template <typename E, typename Call>
std::string messageOf(const Call& call)
{
    try {
        call();
    } catch (const E& error) {
        return error.what();
    } catch (const std::exception& error) {
        ADD_FAILURE() << "threw something else: " << error.what();
        return {};
    }
    ADD_FAILURE() << "threw nothing";
    return {};
}

/// Whether @a text holds @a part.
::testing::AssertionResult mentions(const std::string& text, const std::string& part);

} // namespace spheretree_test
