// SPDX-License-Identifier: Apache-2.0
/// @file JsonWriter.h
/// @brief Writes JSON, indented, for the exporters and for -stats. Numbers read back to the same
/// value; what JSON has no number for (an infinity, say) becomes null; text that is not UTF-8 is
/// repaired.

#pragma once

#include <cstdint>
#include <string>

namespace openvdb_spheretree {

class JsonWriter {
public:
    /// @name Objects and arrays; the key is left out inside an array and at the top
    /// @{
    void beginObject(const std::string& key = {});
    void endObject();
    void beginArray(const std::string& key = {}, bool onOneLine = false);
    void endArray();
    /// @}

    /// @name Values
    /// @{
    void value(const std::string& key, const std::string& text);
    void value(const std::string& key, const char* text) { value(key, std::string(text)); }
    void value(const std::string& key, double number);
    void value(const std::string& key, int64_t number);
    void value(const std::string& key, int number) { value(key, int64_t(number)); }
    void value(const std::string& key, bool truth);
    void null(const std::string& key);
    /// @}

    /// What has been written since the last clearText(): whole tokens, but not yet valid JSON
    /// before the last bracket is closed.
    const std::string& text() const { return mText; }
    /// Forgets the text, which has gone where it should, and goes on after it.
    void clearText() { mText.clear(); }

private:
    void item(const std::string& key);
    void open(const std::string& key, char bracket);
    void close(char bracket);
    void newLine();
    void quote(const std::string& text);

    std::string mText;
    int mDepth = 0;
    bool mFirst = true, mOnOneLine = false;
};

} // namespace openvdb_spheretree
