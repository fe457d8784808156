// SPDX-License-Identifier: Apache-2.0
#include "VdbTag.h"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <istream>
#include <vector>

namespace command {

namespace {

constexpr size_t kBufferSize = 1 << 20;
constexpr size_t kVersion = 14; // the digit of the identifier that says how it was made

uint64_t mixed(uint64_t x) { return x ^ x >> 29; }

std::string blankTag() { return std::string(kTagSize, '0'); }

} // namespace

/// Each step is a bijection of the state for a given word, and of the word for a given state: files that
/// differ in one word never have the same.
void FileDigest::addWord(uint64_t word)
{
    mFirst = mixed((mFirst ^ word) * 0x9fb21c651e98df25u);
    mSecond = mixed((mSecond + word) * 0xd6e8feb86659fd93u);
}

void FileDigest::add(const char* bytes, size_t count)
{
    while (count > 0) {
        const size_t filled = mSize % sizeof(mRest);
        const size_t some = std::min(sizeof(mRest) - filled, count);
        uint64_t word;
        if (some == sizeof(word)) {
            std::memcpy(&word, bytes, sizeof(word));
            addWord(word);
        } else {
            std::memcpy(mRest + filled, bytes, some);
            if (filled + some == sizeof(mRest)) {
                std::memcpy(&word, mRest, sizeof(word));
                addWord(word);
                std::memset(mRest, 0, sizeof(mRest));
            }
        }
        bytes += some;
        count -= some;
        mSize += some;
    }
}

std::string FileDigest::tag() const
{
    FileDigest whole = *this;
    uint64_t rest;
    std::memcpy(&rest, mRest, sizeof(rest));
    if (mSize % sizeof(mRest) != 0) whole.addWord(rest);
    whole.addWord(mSize);
    const uint64_t high = (whole.mFirst & ~uint64_t(0xf000)) | 0x8000;
    const uint64_t low = (whole.mSecond & (~uint64_t(0) >> 2)) | uint64_t(1) << 63;
    char text[kTagSize + 1];
    std::snprintf(text, sizeof(text), "%08x-%04x-%04x-%04x-%012llx", unsigned(high >> 32),
        unsigned(high >> 16 & 0xffff), unsigned(high & 0xffff), unsigned(low >> 48),
        static_cast<unsigned long long>(low & 0xffffffffffffu));
    return text;
}

void replaceTag(std::iostream& stream, const std::string& random)
{
    std::string tag(kTagSize, '\0');
    stream.seekg(kTagOffset);
    stream.read(tag.data(), kTagSize);
    if (tag == random) { // or it is another layout: then leave it alone
        stream.seekp(kTagOffset);
        stream.write(blankTag().data(), kTagSize);
        stream.seekp(0, std::ios::end);
        std::streamoff left = stream.tellp();
        FileDigest digest;
        std::vector<char> buffer(kBufferSize);
        stream.seekg(0);
        while (left > 0) {
            const auto some = std::min<std::streamoff>(left, std::streamoff(buffer.size()));
            stream.read(buffer.data(), some);
            digest.add(buffer.data(), size_t(some));
            left -= some;
        }
        stream.seekp(kTagOffset);
        stream.write(digest.tag().data(), kTagSize);
    }
    stream.seekp(0, std::ios::end);
}

TagReader::TagReader(std::streambuf& source) : mSource(source), mBuffer(new char[kBufferSize]) {}

TagReader::int_type TagReader::underflow()
{
    if (mSource.sgetc() == traits_type::eof()) return traits_type::eof();
    // What is at hand, and no more: a pipe may have nothing further for a while.
    const auto atHand = std::max<std::streamsize>(mSource.in_avail(), 1);
    const std::streamsize count =
        mSource.sgetn(mBuffer.get(), std::min(atHand, std::streamsize(kBufferSize)));
    if (mWanted) digest(mBuffer.get(), size_t(count));
    setg(mBuffer.get(), mBuffer.get(), mBuffer.get() + count);
    return traits_type::to_int_type(*gptr());
}

void TagReader::digest(char* bytes, size_t count)
{
    constexpr size_t end = kTagOffset + kTagSize;
    if (mHead.size() < end) {
        const size_t some = std::min(end - mHead.size(), count);
        mHead.append(bytes, some);
        bytes += some;
        count -= some;
        if (mHead.size() < end) return;
        mWanted = mHead[kTagOffset + kVersion] != '4'; // as the random ones of OpenVDB
        std::string head = mHead;
        mDigest.add(head.replace(kTagOffset, kTagSize, blankTag()).data(), end);
    }
    if (mWanted) mDigest.add(bytes, count);
}

bool TagReader::isUnchanged()
{
    if (!mWanted) return true;
    while (underflow() != traits_type::eof()) continue;
    const std::string stored = mHead.substr(kTagOffset), right = mDigest.tag();
    if (stored == right) return true;
    int different = 0;
    for (size_t i = 0; i < kTagSize; ++i) different += stored[i] != right[i];
    // One digit alone that is wrong is that digit's own damage; another version is another's file.
    const bool ours = stored[kVersion] == right[kVersion] || different == 1;
    return !ours;
}

} // namespace command
