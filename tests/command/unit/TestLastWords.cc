// SPDX-License-Identifier: Apache-2.0
// What std::terminate makes the program say, where the exception that led there is known and where
// it is not. Each death is that of a child process: no other test sees that memory was refused.

#include <base/Errors.h>
#include <base/LastWords.h>

#include <gtest/gtest.h>

#include "support/Sanitizers.h"

#include <cstddef>
#include <exception>
#include <new>
#include <stdexcept>
#include <thread>

namespace {

using testing::ExitedWithCode;

constexpr char kLackOfMemory[] = "^vdb_spheretree: error: not enough memory\n$";

void askForTooMuch()
{
    static volatile std::size_t size = PTRDIFF_MAX; // so that no compiler sees what comes of it
    ::operator delete(::operator new(size));
}

bool isRefused()
{
    try {
        askForTooMuch();
    } catch (const std::bad_alloc&) {
        return true;
    }
    return false;
}

struct Cleanup {
    ~Cleanup() { sCleanups = sCleanups + 1; }
    static inline volatile int sCleanups = 0;
};

/// Compiled into its caller, as OpenVDB has Tree::clear() in ~Tree(): the exception is hidden then.
[[gnu::always_inline]] inline void askForTooMuchAndCleanUp()
{
    const Cleanup cleanup;
    askForTooMuch();
}

struct AsksAtTheEnd {
    ~AsksAtTheEnd() { askForTooMuchAndCleanUp(); }
};

class LastWordsDeath : public testing::Test {
protected:
    void SetUp() override
    {
#ifndef __linux__
        GTEST_SKIP() << "no function runs before the libraries";
#endif
        if (spheretree_test::kSanitized) GTEST_SKIP() << "sanitizers have their own operator new";
        command::catchLostPages(); // the linker takes the file for this call
        GTEST_FLAG_SET(death_test_style, "threadsafe");
    }
};

TEST_F(LastWordsDeath, AnExceptionThatIsKnownIsNamed)
{
    EXPECT_EXIT(std::thread(askForTooMuch).join(), ExitedWithCode(command::kInput), kLackOfMemory);
    EXPECT_EXIT(std::thread([] { throw std::runtime_error("?"); }).join(),
        ExitedWithCode(command::kInternal), "unexpected exception outside of all actions");
    const auto afterRefusal = [] {
        isRefused();
        std::thread([] { throw std::runtime_error("?"); }).join();
    };
    EXPECT_EXIT(afterRefusal(), ExitedWithCode(command::kInternal), "outside of all actions");
}

TEST_F(LastWordsDeath, AnEndWithoutAnExceptionIsALackOfMemoryOnlyIfMemoryWasRefused)
{
    EXPECT_EXIT(std::terminate(), ExitedWithCode(command::kInternal), "without an exception");
    const auto afterRefusal = [] {
        if (isRefused()) std::terminate();
    };
    EXPECT_EXIT(afterRefusal(), ExitedWithCode(command::kInput), kLackOfMemory);
}

TEST_F(LastWordsDeath, AnExceptionThatADestructorHoldsBackIsALackOfMemory)
{
    EXPECT_EXIT(AsksAtTheEnd(), ExitedWithCode(command::kInput), kLackOfMemory);
    const auto whileHandlingAnother = [] {
        try {
            throw std::runtime_error("?");
        } catch (const std::runtime_error&) {
            AsksAtTheEnd();
        }
    };
    EXPECT_EXIT(whileHandlingAnother(), ExitedWithCode(command::kInput), kLackOfMemory);
}

} // namespace
