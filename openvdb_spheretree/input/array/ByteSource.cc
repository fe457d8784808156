// SPDX-License-Identifier: Apache-2.0
#include "ByteSource.h"

#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace openvdb_spheretree::detail {

using openvdb::IoError;

bool isBigEndianMachine()
{
    const uint16_t one = 1;
    uint8_t first;
    std::memcpy(&first, &one, 1);
    return first == 0;
}

void RawBytes::read(uint8_t* out, uint64_t bytes)
{
    mFile.read(reinterpret_cast<char*>(out), std::streamsize(bytes));
    if (uint64_t(mFile.gcount()) < bytes) {
        throw IoError("cannot read the values: the file ends early");
    }
}

InflatedBytes::InflatedBytes(std::istream& file, Wrapper wrapper)
    : mFile(file), mGzip(wrapper == Wrapper::Gzip), mInput(1 << 16)
{
    constexpr int kGzip = 16; // added to the size of the window, zlib expects gzip
    if (inflateInit2(&mZlib, MAX_WBITS + (mGzip ? kGzip : 0)) != Z_OK) throw std::bad_alloc();
}

InflatedBytes::~InflatedBytes() { inflateEnd(&mZlib); }

void InflatedBytes::read(uint8_t* out, uint64_t bytes)
{
    if (inflateInto(out, bytes) < bytes) {
        throw IoError(name() + " ends before the values of the header do");
    }
}

/// The stream must end here, with its checksum, and so must the file.
void InflatedBytes::finish()
{
    uint8_t extra = 0;
    if (inflateInto(&extra, 1) != 0) {
        throw IoError(name() + " holds more than the values of the header");
    }
    if (mZlib.avail_in > 0 || refill()) throw IoError("bytes follow the end of " + name());
}

/// @return how many bytes came; fewer than asked for only where the stream ends soundly.
uint64_t InflatedBytes::inflateInto(uint8_t* out, uint64_t bytes)
{
    uint64_t done = 0;
    while (done < bytes && !mEnded) {
        if (mZlib.avail_in == 0 && !refill()) throw IoError(name() + " is truncated");
        const auto room = uInt(std::min<uint64_t>(bytes - done, 1u << 30));
        mZlib.next_out = out + done;
        mZlib.avail_out = room;
        const int code = inflate(&mZlib, Z_NO_FLUSH);
        done += room - mZlib.avail_out;
        if (code == Z_MEM_ERROR) throw std::bad_alloc();
        if (code != Z_OK && code != Z_STREAM_END && code != Z_BUF_ERROR) {
            throw IoError(name() + " is damaged"
                + (mZlib.msg ? " (" + std::string(mZlib.msg) + ")" : std::string()));
        }
        if (code != Z_STREAM_END) continue;
        const bool another = mGzip && (mZlib.avail_in > 0 || refill());
        if (another) inflateReset(&mZlib);
        else mEnded = true;
    }
    return done;
}

/// @return whether there was more in the file.
bool InflatedBytes::refill()
{
    mFile.read(reinterpret_cast<char*>(mInput.data()), std::streamsize(mInput.size()));
    mZlib.next_in = mInput.data();
    mZlib.avail_in = uInt(mFile.gcount());
    return mZlib.avail_in > 0;
}

namespace {

template <typename Number>
void store(const std::string& word, uint64_t place, uint8_t* out)
{
    const auto number = parseNumber<Number>(word);
    if (!number) {
        throw IoError(
            "number " + std::to_string(place) + " is " + inQuotes(word) + ", not one of its type");
    }
    std::memcpy(out, &*number, sizeof(Number));
}

void storeAs(NumberType type, const std::string& word, uint64_t place, uint8_t* out)
{
    switch (type) {
    case NumberType::Bool:
    case NumberType::UInt8: return store<uint8_t>(word, place, out);
    case NumberType::Int8: return store<int8_t>(word, place, out);
    case NumberType::Int16: return store<int16_t>(word, place, out);
    case NumberType::UInt16: return store<uint16_t>(word, place, out);
    case NumberType::Int32: return store<int32_t>(word, place, out);
    case NumberType::UInt32: return store<uint32_t>(word, place, out);
    case NumberType::Int64: return store<int64_t>(word, place, out);
    case NumberType::UInt64: return store<uint64_t>(word, place, out);
    case NumberType::Float32: return store<float>(word, place, out);
    case NumberType::Float64: return store<double>(word, place, out);
    case NumberType::Float16: throw IoError("text of type float16 is not read");
    }
}

} // namespace

/// @return whether there was another one. A word is no longer than any number.
bool TextNumbers::nextWord()
{
    constexpr std::size_t kLongest = 400; // digits of the smallest double, all written out
    const auto isBlank = [](int c) { return c == ' ' || c == ',' || (c >= '\t' && c <= '\r'); };
    constexpr auto kEnd = std::istream::traits_type::eof();
    std::streambuf& bytes = *mFile.rdbuf();
    int c = bytes.sgetc();
    while (c != kEnd && isBlank(c)) c = bytes.snextc();
    mWord.clear();
    for (; c != kEnd && !isBlank(c) && mWord.size() < kLongest; c = bytes.snextc()) {
        mWord += char(c);
    }
    return !mWord.empty();
}

void TextNumbers::read(uint8_t* out, uint64_t bytes)
{
    const auto size = uint64_t(bytesOf(mType));
    for (uint64_t done = 0; done + size <= bytes; done += size) {
        if (!nextWord()) {
            throw IoError("the text ends after " + std::to_string(mCount)
                + " numbers, before the values of the header do");
        }
        storeAs(mType, mWord, mCount++, out + done);
    }
}

void TextNumbers::finish()
{
    if (nextWord()) throw IoError("the text holds more numbers than the header says");
}

} // namespace openvdb_spheretree::detail
