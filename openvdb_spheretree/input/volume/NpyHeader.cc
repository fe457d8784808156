// SPDX-License-Identifier: Apache-2.0
/// @file NpyHeader.cc
/// @brief The header of a `.npy`: magic bytes, a version, a length, and a dictionary of Python's with
/// three keys, such as {'descr': '<f4', 'fortran_order': False, 'shape': (4, 5, 6), }.

#include "VolumeHeader.h"

#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <optional>

namespace openvdb_spheretree::detail {
namespace {

using openvdb::IoError;

/// What is read of Python, and nothing else.
class Dictionary {
public:
    explicit Dictionary(const std::string& text) : mText(text) {}

    void read()
    {
        expect('{');
        while (!next('}')) {
            const std::string key = quoted();
            expect(':');
            if (key == "descr") set(mType, quotedType(), key);
            else if (key == "fortran_order") set(mFortran, truth(), key);
            else if (key == "shape") set(mShape, numbers(), key);
            else throw IoError("its header has a key " + inQuotes(key) + " that is not known");
            if (!next(',')) {
                expect('}');
                break;
            }
        }
        skipBlanks();
        if (mAt != mText.size()) fail();
        if (!mType || !mFortran || !mShape) {
            throw IoError("its header lacks one of 'descr', 'fortran_order' and 'shape'");
        }
    }

    const std::string& type() const { return *mType; }
    bool isFortran() const { return *mFortran; }
    const std::vector<uint64_t>& shape() const { return *mShape; }

private:
    [[noreturn]] void fail() const
    {
        throw IoError("its header is no dictionary of numpy's: " + inQuotes(mText.substr(mAt)));
    }
    template <typename Value>
    static void set(std::optional<Value>& slot, Value value, const std::string& key)
    {
        if (slot) throw IoError("its header has the key '" + key + "' twice");
        slot = std::move(value);
    }
    void skipBlanks()
    {
        while (mAt < mText.size() && (mText[mAt] == ' ' || mText[mAt] == '\n')) ++mAt;
    }
    bool next(char c)
    {
        skipBlanks();
        if (mAt >= mText.size() || mText[mAt] != c) return false;
        ++mAt;
        return true;
    }
    void expect(char c)
    {
        if (!next(c)) fail();
    }
    std::string quoted()
    {
        skipBlanks();
        const char quote = mAt < mText.size() ? mText[mAt] : ' ';
        if (quote != '\'' && quote != '"') fail();
        const auto end = mText.find(quote, mAt + 1);
        if (end == std::string::npos) fail();
        const std::string word = mText.substr(mAt + 1, end - mAt - 1);
        mAt = end + 1;
        return word;
    }
    std::string quotedType()
    {
        if (next('['))
            throw IoError("its numbers are records of several fields: save one of these");
        return quoted();
    }
    bool truth()
    {
        skipBlanks();
        for (const char* word : {"True", "False"}) {
            const std::string text = word;
            if (mText.compare(mAt, text.size(), text) != 0) continue;
            mAt += text.size();
            return text == "True";
        }
        fail();
    }
    /// Of a tuple: up to 32, as numpy has.
    std::vector<uint64_t> numbers()
    {
        std::vector<uint64_t> sides;
        expect('(');
        while (!next(')')) {
            skipBlanks();
            const auto end = std::min(mText.find_first_not_of("0123456789", mAt), mText.size());
            const auto side = parseNumber<uint64_t>(std::string_view(mText).substr(mAt, end - mAt));
            if (!side || sides.size() == 32) fail();
            sides.push_back(*side);
            mAt = end;
            if (!next(',')) {
                expect(')');
                break;
            }
        }
        return sides;
    }

    const std::string mText;
    std::size_t mAt = 0;
    std::optional<std::string> mType;
    std::optional<bool> mFortran;
    std::optional<std::vector<uint64_t>> mShape;
};

NumberType typeOf(const std::string& code)
{
    if (code == "b1") return NumberType::Bool;
    if (code == "i1") return NumberType::Int8;
    if (code == "u1") return NumberType::UInt8;
    if (code == "i2") return NumberType::Int16;
    if (code == "u2") return NumberType::UInt16;
    if (code == "i4") return NumberType::Int32;
    if (code == "u4") return NumberType::UInt32;
    if (code == "i8") return NumberType::Int64;
    if (code == "u8") return NumberType::UInt64;
    if (code == "f2") return NumberType::Float16;
    if (code == "f4") return NumberType::Float32;
    if (code == "f8") return NumberType::Float64;
    throw IoError("its numbers are of numpy's type " + inQuotes(code)
        + (code == "O" ? ", Python objects, which are not read" : "")
        + ": save it as bools, integers or floats (array.astype('float32'))");
}

/// @return the text of the dictionary.
std::string headerText(std::istream& file, uint64_t fileBytes)
{
    constexpr char kMagic[] = "\x93NUMPY";
    constexpr uint64_t kMost = 1 << 16;
    uint8_t start[12] = {};
    file.read(reinterpret_cast<char*>(start), 8);
    if (file.gcount() < 8 || !std::equal(kMagic, kMagic + 6, reinterpret_cast<char*>(start))) {
        throw IoError("is no .npy: it does not begin as one");
    }
    const int version = start[6];
    if (version < 1 || version > 3) {
        throw IoError("is a .npy of version " + std::to_string(version) + "; 1 to 3 are read");
    }
    const int size = version == 1 ? 2 : 4;
    file.read(reinterpret_cast<char*>(start + 8), size);
    uint64_t length = 0;
    for (int i = 0; i < size; ++i) length |= uint64_t(start[8 + i]) << 8 * i;
    const uint64_t before = 8 + uint64_t(size);
    if (file.gcount() < size || fileBytes < before || length > fileBytes - before) {
        throw IoError("ends within its header");
    }
    if (length > kMost) throw IoError("has a header of more than 65536 bytes");
    std::string text(length, '\0');
    file.read(text.data(), std::streamsize(length));
    if (uint64_t(file.gcount()) < length) throw IoError("ends within its header");
    return text;
}

} // namespace

VolumeHeader readNpyHeader(std::istream& file, uint64_t fileBytes, bool zyx)
{
    Dictionary dictionary(headerText(file, fileBytes));
    dictionary.read();
    const std::string& type = dictionary.type();
    const auto order = type.find_first_of("<>=|") == 0 ? type[0] : ' ';
    VolumeHeader header;
    header.layout.type = typeOf(order == ' ' ? type : type.substr(1));
    header.layout.bigEndian = order == '>' || (order != '<' && isBigEndianMachine());
    std::vector<uint64_t> sides = dictionary.shape(); // of the first index, the second, ...
    const bool firstIsFast = dictionary.isFortran();
    if (!firstIsFast) std::reverse(sides.begin(), sides.end());
    const std::array<uint64_t, 3> fast = threeSides(sides);
    // Which axis is the fastest. A picture has two, and lies in x and y.
    const bool flat = sides.size() == 2;
    if (firstIsFast == zyx) header.layout.order = flat ? std::array{1, 0, 2} : std::array{2, 1, 0};
    for (int i = 0; i < 3; ++i) header.layout.dim[header.layout.order[i]] = fast[i];
    return header;
}

} // namespace openvdb_spheretree::detail
