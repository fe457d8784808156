// SPDX-License-Identifier: Apache-2.0
// A string stream that lacks memory throws, and drops nothing in silence.

#include <openvdb_spheretree/base/TextStream.h>

#include <gtest/gtest.h>

#include <new>

namespace {

using openvdb_spheretree::detail::TextStream;

/// Has no memory for anything.
class FullBuffer : public std::stringbuf {
protected:
    int_type overflow(int_type) override { throw std::bad_alloc(); }
    std::streamsize xsputn(const char*, std::streamsize) override { throw std::bad_alloc(); }
    int_type underflow() override { throw std::bad_alloc(); }
};

TEST(TextStream, WritesAndReads)
{
    TextStream out;
    out << "radius " << 2;
    EXPECT_EQ(out.str(), "radius 2");
    TextStream in("one two");
    std::string first, second, third;
    EXPECT_TRUE(in >> first >> second);
    EXPECT_EQ(first + second, "onetwo");
    EXPECT_FALSE(in >> third);
}

TEST(TextStream, ThrowsWhereMemoryLacks)
{
    FullBuffer full;
    TextStream empty, text("text");
    for (TextStream* stream : {&empty, &text}) {
        static_cast<std::ios&>(*stream).rdbuf(&full);
        std::string word;
        EXPECT_THROW(*stream << "text", std::bad_alloc);
        stream->clear();
        EXPECT_THROW(stream->write("text", 4), std::bad_alloc);
        stream->clear();
        EXPECT_THROW(*stream >> word, std::bad_alloc);
        stream->clear();
    }
}

} // namespace
