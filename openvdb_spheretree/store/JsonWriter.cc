// SPDX-License-Identifier: Apache-2.0
#include "JsonWriter.h"

#include <openvdb_spheretree/base/Utf8.h>

#include <charconv>
#include <cmath>
#include <cstdio>

namespace openvdb_spheretree {

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
        const size_t length = detail::utf8Length(text, i);
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
