// SPDX-License-Identifier: Apache-2.0
/// @file ByteSource.h
/// @brief The bytes of an array, in file order: as they stand in a file, inflated as they are asked
/// for, or from numbers written as text.

#pragma once

#include "ArrayLayout.h"

#include <zlib.h>

#include <cstdint>
#include <istream>
#include <string>
#include <vector>

namespace openvdb_spheretree::detail {

/// What is thrown are openvdb::IoErrors without the name of a file.
class ByteSource {
public:
    ByteSource() = default;
    virtual ~ByteSource() = default;
    ByteSource(const ByteSource&) = delete;
    ByteSource& operator=(const ByteSource&) = delete;

    /// @throw openvdb::IoError if there are fewer
    virtual void read(uint8_t* out, uint64_t bytes) = 0;
    /// To be called after the last byte: what follows is an error where it can be told.
    virtual void finish() {}
};

/// The rest of a file, raw. Its length is to be checked by requireHeld().
class RawBytes final : public ByteSource {
public:
    explicit RawBytes(std::istream& file) : mFile(file) {}
    void read(uint8_t* out, uint64_t bytes) override;

private:
    std::istream& mFile;
};

/// The rest of a file, one zlib stream, or gzip of one or more members.
class InflatedBytes final : public ByteSource {
public:
    enum class Wrapper { Zlib, Gzip };
    InflatedBytes(std::istream& file, Wrapper wrapper);
    ~InflatedBytes() override;

    void read(uint8_t* out, uint64_t bytes) override;
    void finish() override;

private:
    uint64_t inflateInto(uint8_t* out, uint64_t bytes);
    bool refill();
    std::string name() const { return mGzip ? "the gzip stream" : "the zlib stream"; }

    std::istream& mFile;
    const bool mGzip;
    bool mEnded = false;
    z_stream mZlib{};
    std::vector<uint8_t> mInput;
};

/// The rest of a file: numbers as text, with blanks or commas between. Gives them as this machine
/// holds numbers of that type: a layout of them is not of the other byte order.
class TextNumbers final : public ByteSource {
public:
    TextNumbers(std::istream& file, NumberType type) : mFile(file), mType(type) {}
    void read(uint8_t* out, uint64_t bytes) override;
    void finish() override;

private:
    bool nextWord();

    std::istream& mFile;
    const NumberType mType;
    std::string mWord;
    uint64_t mCount = 0; ///< numbers so far
};

/// @return whether this machine's numbers begin with their highest byte.
bool isBigEndianMachine();

} // namespace openvdb_spheretree::detail
