// SPDX-License-Identifier: Apache-2.0
#include "JsonWriter.h"

#include <charconv>
#include <cmath>
#include <cstdio>

namespace openvdb_spheretree {

namespace {

/// @return the length of the well-formed UTF-8 character at @a at, 0 if there is none.
size_t utf8Length(const std::string& text, size_t at)
{
    const auto byte = [&](size_t i) {
        return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u;
    };
    const unsigned first = byte(at);
    if (first < 0x80) return 1;
    const size_t length = first >= 0xf0 ? 4 : first >= 0xe0 ? 3 : 2;
    if (first < 0xc2 || first > 0xf4) return 0;
    for (size_t i = 1; i < length; ++i) {
        if ((byte(at + i) & 0xc0) != 0x80) return 0;
    }
    // Overlong forms, surrogates, and what lies beyond Unicode.
    const unsigned second = byte(at + 1);
    if ((first == 0xe0 && second < 0xa0) || (first == 0xed && second > 0x9f)) return 0;
    if ((first == 0xf0 && second < 0x90) || (first == 0xf4 && second > 0x8f)) return 0;
    return length;
}

} // namespace

void JsonWriter::item(const std::string& key)
{
    if (!mFirst) mText += mOnOneLine ? ", " : ",";
    if (mDepth > 0 && !mOnOneLine) mText += "\n" + std::string(size_t(2 * mDepth), ' ');
    mFirst = false;
    if (key.empty()) return;
    quote(key);
    mText += ": ";
}

void JsonWriter::open(const std::string& key, char bracket)
{
    item(key);
    mText += bracket;
    ++mDepth;
    mFirst = true;
}

void JsonWriter::close(char bracket)
{
    --mDepth;
    if (!mFirst && !mOnOneLine) mText += "\n" + std::string(size_t(2 * mDepth), ' ');
    mText += bracket;
    mFirst = false;
    mOnOneLine = false;
    if (mDepth == 0) mText += '\n';
}

void JsonWriter::quote(const std::string& text)
{
    mText += '"';
    for (size_t i = 0; i < text.size();) {
        const size_t length = utf8Length(text, i);
        const auto byte = static_cast<unsigned char>(text[i]);
        if (length == 0) {
            mText += "\\ufffd";
        } else if (byte == '"' || byte == '\\') {
            mText += {'\\', text[i]};
        } else if (byte < 32) {
            char escape[8];
            std::snprintf(escape, sizeof(escape), "\\u%04x", byte);
            mText += escape;
        } else {
            mText.append(text, i, length);
        }
        i += length ? length : 1;
    }
    mText += '"';
}

void JsonWriter::value(const std::string& key, const std::string& text)
{
    item(key);
    quote(text);
}

void JsonWriter::value(const std::string& key, double number)
{
    if (!std::isfinite(number)) return null(key);
    item(key);
    char buffer[32];
    mText.append(buffer, std::to_chars(buffer, buffer + sizeof(buffer), number).ptr);
}

} // namespace openvdb_spheretree
