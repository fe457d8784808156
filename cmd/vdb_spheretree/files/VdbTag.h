// SPDX-License-Identifier: Apache-2.0
/// @file VdbTag.h
/// @brief The identifier in the header of a `.vdb`. OpenVDB writes a random one; in files that are
/// written here it is a digest of the rest of the file, so that any bit that flips is noticed.

#pragma once

#include <cstdint>
#include <iosfwd>
#include <memory>
#include <streambuf>
#include <string>

namespace command {

/// A header is: magic (8 bytes), file version (4), library version (8), has offsets (1), identifier.
constexpr size_t kTagOffset = 21;
constexpr size_t kTagSize = 36;

/// Two independent 64-bit mixes of the bytes of a file, in words of 8.
class FileDigest {
public:
    void add(const char* bytes, size_t count);

    /// @return the form of a UUID of version 8 (RFC 9562: bits of the application's own choice).
    std::string tag() const;

private:
    void addWord(uint64_t word);

    uint64_t mFirst = 0x243f6a8885a308d3u, mSecond = 0x13198a2e03707344u;
    uint64_t mSize = 0;
    char mRest[8] = {}; ///< bytes of a word that is not complete yet, then zeros
};

/// @brief Put the digest of a `.vdb` into its header, and the stream's place at its end.
/// @param stream  open for reading and writing
/// @param random  the identifier that OpenVDB has put there; where another one stands, nothing is done
void replaceTag(std::iostream& stream, const std::string& random);

/// Passes a `.vdb` on, and computes its digest meanwhile, unless OpenVDB made the identifier.
class TagReader : public std::streambuf {
public:
    /// @param source  at the start of the file; outlives this
    explicit TagReader(std::streambuf& source);

    /// @brief To be called once, when all is read that is wanted: look at what is left.
    /// @return false if the file was written here, and is not as it was
    bool isUnchanged();

protected:
    int_type underflow() override;

private:
    void digest(char* bytes, size_t count);

    std::streambuf& mSource;
    std::unique_ptr<char[]> mBuffer;
    std::string mHead; ///< up to the end of the identifier
    FileDigest mDigest;
    bool mWanted = true;
};

} // namespace command
