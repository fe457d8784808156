// SPDX-License-Identifier: Apache-2.0
/// @file JsonWriter.h
/// @brief Writes JSON, indented, for writeJson() and for -stats. Numbers read back to the same
/// value. What JSON has no number for, such as an infinity, becomes null. Text that is not UTF-8 is
/// repaired.

#pragma once

#include <cstdint>
#include <string>

namespace openvdb_spheretree {

struct SphereTree;
struct SphereTreeLevel;

class JsonWriter {
public:
    /// @name Objects and arrays; the key is left out inside an array and at the top
    /// @{
    void beginObject(const std::string& key = {}) { open(key, '{'); }
    void endObject() { close('}'); }
    void beginArray(const std::string& key = {}, bool onOneLine = false)
    {
        open(key, '[');
        mOnOneLine = onOneLine;
    }
    void endArray() { close(']'); }
    /// @}

    /// @name Values
    /// @{
    void value(const std::string& key, const std::string& text);
    void value(const std::string& key, const char* text) { value(key, std::string(text)); }
    void value(const std::string& key, double number);
    void value(const std::string& key, int64_t number) { token(key, std::to_string(number)); }
    void value(const std::string& key, int number) { token(key, std::to_string(number)); }
    void value(const std::string& key, bool truth) { token(key, truth ? "true" : "false"); }
    void null(const std::string& key) { token(key, "null"); }
    /// @}

    /// What has been written since the last clearText(): whole tokens.
    const std::string& text() const { return mText; }
    /// Forgets the text, and goes on after it.
    void clearText() { mText.clear(); }

private:
    void item(const std::string& key);
    void open(const std::string& key, char bracket);
    void close(char bracket);
    void quote(const std::string& text);
    void token(const std::string& key, const std::string& text)
    {
        item(key);
        mText += text;
    }

    std::string mText;
    int mDepth = 0;
    bool mFirst = true, mOnOneLine = false;
};

/// @name What writeJson() and -stats have in common (SphereTreeJson.cc)
/// @{
void writeObject(JsonWriter& json, const SphereTree& tree);
/// The members of "settings", which the caller has begun.
void writeSettings(JsonWriter& json, const SphereTree& tree);
void writeTopology(JsonWriter& json, const SphereTreeLevel& level);
void writeError(JsonWriter& json, const SphereTreeLevel& level);
/// @}

} // namespace openvdb_spheretree
