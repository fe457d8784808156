// SPDX-License-Identifier: Apache-2.0
#include "Mutants.h"

#include <array>
#include <cstring>

namespace spheretree_test {

namespace {

/// A number of which readers have gone wrong: near 0, near the ends of a type, or near @a size.
uint64_t hurtfulNumber(std::size_t size, Random& random)
{
    constexpr std::array<uint64_t, 14> kNumbers = {0, 1, 2, 0x7f, 0x80, 0xff, 0x7fff, 0xffff,
        0x7fffffff, 0x80000000, 0xffffffff, 0x7fffffffffffffff, 0x8000000000000000,
        0xffffffffffffffff};
    switch (below(4, random)) {
    case 0: return uint64_t(size) - below(4, random);
    case 1: return uint64_t(1) << below(64, random);
    case 2: return uint64_t(0) - below(5000, random);
    default: return kNumbers[below(kNumbers.size(), random)];
    }
}

/// Writes the lowest @a width bytes of the number, little-endian.
void writeNumber(std::string& bytes, std::size_t at, uint64_t number, std::size_t width)
{
    for (std::size_t i = 0; i < width && at + i < bytes.size(); ++i) {
        bytes[at + i] = char(number >> (8 * i));
    }
}

uint64_t readNumber(const std::string& bytes, const Field& field)
{
    uint64_t number = 0;
    std::memcpy(&number, bytes.data() + field.offset, std::min(field.size, sizeof(number)));
    return number;
}

void flipBit(std::string& bytes, std::size_t begin, std::size_t size, Random& random)
{
    bytes[begin + below(size, random)] ^= char(1 << below(8, random));
}

void changeSomewhere(std::string& bytes, Random& random)
{
    if (bytes.empty()) bytes = "\1";
    const std::size_t at = below(bytes.size(), random), other = below(bytes.size(), random);
    const std::size_t most = std::min<std::size_t>(bytes.size() - at, 64);
    const std::size_t length = 1 + below(most, random);
    switch (below(9, random)) {
    case 0: bytes[at] = char(random()); return;
    case 1: flipBit(bytes, at, 1, random); return;
    case 2: return writeNumber(bytes, at, hurtfulNumber(bytes.size(), random), 4);
    case 3: return writeNumber(bytes, at, hurtfulNumber(bytes.size(), random), 8);
    case 4: bytes.erase(at, length); return;
    case 5: bytes.insert(other, bytes.substr(at, length)); return;
    case 6: bytes.insert(at, 1, char(random())); return;
    case 7: bytes.replace(at, length, bytes.substr(other, length)); return;
    default: std::fill_n(bytes.begin() + std::ptrdiff_t(at), length, random() % 2 ? '\0' : '\xff');
    }
}

/// A mask, a text or a block of values, which may start with the header of its compression.
void changeBlock(std::string& bytes, const Field& field, Random& random)
{
    constexpr std::size_t kHeader = 16;
    switch (below(5, random)) {
    case 0: return flipBit(bytes, field.offset, field.size, random);
    case 1: return flipBit(bytes, field.offset, std::min(kHeader, field.size), random);
    case 2: {
        const std::size_t word = below(std::max<std::size_t>(field.size / 4, 1), random) % 4;
        return writeNumber(bytes, field.offset + 4 * word, hurtfulNumber(field.size, random), 4);
    }
    case 3: bytes[field.offset + below(field.size, random)] = char(random()); return;
    default: std::memset(bytes.data() + field.offset, random() % 2 ? 0 : 0xff, field.size);
    }
}

void changeNumber(std::string& bytes, const Field& field, Random& random)
{
    const uint64_t old = readNumber(bytes, field);
    switch (below(4, random)) {
    case 0: return writeNumber(bytes, field.offset, old + 1, field.size);
    case 1: return writeNumber(bytes, field.offset, old - 1, field.size);
    case 2: return writeNumber(bytes, field.offset, uint64_t(0) - old, field.size);
    default:
        return writeNumber(
            bytes, field.offset, hurtfulNumber(std::size_t(old), random), field.size);
    }
}

/// The text after a length gets longer or shorter, and its length with it.
void changeText(std::string& bytes, const Field& length, Random& random)
{
    const std::size_t begin = length.offset + length.size;
    const uint64_t size = readNumber(bytes, length);
    if (size > bytes.size() - begin) return;
    const std::size_t wanted = below(2 * std::size_t(size) + 2, random);
    std::string text = bytes.substr(begin, std::size_t(size));
    text.resize(wanted, char(random()));
    bytes.replace(begin, std::size_t(size), text);
    writeNumber(bytes, length.offset, wanted, length.size);
}

} // namespace

std::string randomMutant(std::string bytes, Random& random)
{
    for (std::size_t left = 1 + below(4, random); left > 0; --left) {
        changeSomewhere(bytes, random);
    }
    return bytes;
}

std::string fieldMutant(std::string bytes, const std::vector<Field>& fields, Random& random)
{
    if (fields.empty()) return randomMutant(std::move(bytes), random);
    const Field field = fields[below(fields.size(), random)];
    const Field other = fields[below(fields.size(), random)];
    const bool isNumber = field.size <= 8;
    switch (below(10, random)) {
    case 0: bytes.erase(field.offset, field.size); return bytes;
    case 1: bytes.insert(other.offset, bytes.substr(field.offset, field.size)); return bytes;
    case 2:
        bytes.replace(field.offset, field.size, bytes.substr(other.offset, field.size));
        return bytes;
    case 3:
        if (field.size == 4) changeText(bytes, field, random);
        else changeBlock(bytes, field, random);
        return bytes;
    case 4: // two at once: a count and what it counts may have to change together
        changeBlock(bytes, other, random);
        break;
    default: break;
    }
    if (isNumber && field.size > 1) changeNumber(bytes, field, random);
    else if (isNumber) bytes[field.offset] = char(below(8, random));
    else changeBlock(bytes, field, random);
    return bytes;
}

} // namespace spheretree_test
