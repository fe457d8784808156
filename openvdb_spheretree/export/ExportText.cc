// SPDX-License-Identifier: Apache-2.0
#include "ExportText.h"

#include <openvdb_spheretree/base/Text.h>
#include <openvdb_spheretree/base/Utf8.h>
#include <openvdb_spheretree/store/JsonWriter.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>

namespace openvdb_spheretree::detail {

namespace {

bool isWordLetter(char c) { return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_'; }

constexpr std::size_t kLongestYamlKey = 1000; ///< readers look for the colon within 1024

/// What JSON may hold as it is, and YAML 1.1 may not, or takes for the end of a line.
struct NotInYaml {
    std::string_view bytes, escape;
};
constexpr std::array<NotInYaml, 6> kNotInYaml = {
    {{"\x7f", "\\u007f"}, {"\xe2\x80\xa8", "\\u2028"}, {"\xe2\x80\xa9", "\\u2029"},
        {"\xef\xbb\xbf", "\\ufeff"}, {"\xef\xbf\xbe", "\\ufffe"}, {"\xef\xbf\xbf", "\\uffff"}}};

/// @return what stands for a letter in XML 1.0, which has no place for most control letters and for two others.
std::string_view xmlLetter(std::string_view letter)
{
    switch (letter.front()) {
    case '&': return "&amp;";
    case '<': return "&lt;";
    case '>': return "&gt;";
    case '"': return "&quot;";
    case '\t': return "&#9;"; // as they are they would be read as blanks
    case '\n': return "&#10;";
    case '\r': return "&#13;";
    default: break;
    }
    const bool isControl = static_cast<unsigned char>(letter.front()) < 32;
    if (isControl || letter == "\xef\xbf\xbe" || letter == "\xef\xbf\xbf") return kNoLetter;
    return letter;
}

/// @return the number of the control letter U+0080 to U+009F that stands at @a i in UTF-8; 0 if none does.
int controlAt(const std::string& text, std::size_t i)
{
    if (text[i] != '\xc2' || i + 1 >= text.size()) return 0;
    const auto byte = static_cast<unsigned char>(text[i + 1]);
    return byte >= 0x80 && byte < 0xa0 ? byte : 0;
}

} // namespace

ExportText::ExportText(const ExportSink& out, int decimals) : ExportBuffer(out)
{
    useDecimals(decimals);
}

void ExportText::useDecimals(int decimals)
{
    mDecimals = decimals;
    mUnits = std::pow(10.0, decimals);
}

ExportText& ExportText::writeWhole(int64_t number)
{
    std::array<char, 24> digits;
    mBytes.append(
        digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
    return *this;
}

ExportText& ExportText::operator<<(double length)
{
    const double units = std::nearbyint(length * mUnits);
    std::array<char, 24> digits;
    const auto whole = uint64_t(std::abs(units)); // at most 2^53: requireDecimals()
    const char* const end = std::to_chars(digits.data(), digits.data() + digits.size(), whole).ptr;
    const auto count = int(end - digits.data());
    if (units < 0) mBytes += '-';
    const int beforePoint = count - mDecimals;
    int kept = count; // without zeros at the end
    while (kept > std::max(beforePoint, 0) && digits[std::size_t(kept - 1)] == '0') --kept;
    if (kept == 0) {
        mBytes += "0.0";
    } else if (beforePoint <= 0) {
        mBytes += "0.";
        mBytes.append(std::size_t(-beforePoint), '0');
        mBytes.append(digits.data(), std::size_t(kept));
    } else {
        mBytes.append(digits.data(), std::size_t(beforePoint));
        mBytes += '.';
        if (kept == beforePoint) mBytes += '0';
        mBytes.append(digits.data() + beforePoint, std::size_t(kept - beforePoint));
    }
    return *this;
}

ExportText& ExportText::lengths(const openvdb::Vec3d& vector, std::string_view separator)
{
    *this << vector[0] << separator << vector[1] << separator << vector[2];
    return *this;
}

ExportText& ExportText::asFloat(double number)
{
    std::array<char, 32> digits;
    mBytes.append(digits.data(),
        std::to_chars(digits.data(), digits.data() + digits.size(), float(number)).ptr);
    return *this;
}

ExportText& ExportText::floats(const openvdb::Vec3d& vector, std::string_view separator)
{
    asFloat(vector[0]) << separator;
    asFloat(vector[1]) << separator;
    return asFloat(vector[2]);
}

ExportText& ExportText::real(double number)
{
    std::array<char, 32> digits;
    mBytes.append(
        digits.data(), std::to_chars(digits.data(), digits.data() + digits.size(), number).ptr);
    return *this;
}

ExportText& ExportText::reals(const double* numbers, std::size_t count)
{
    for (std::size_t i = 0; i < count; ++i) {
        if (i > 0) mBytes += ' ';
        real(numbers[i]);
    }
    return *this;
}

bool isXmlText(std::string_view text)
{
    for (std::size_t i = 0; i < text.size();) {
        const std::string_view letter = text.substr(i, utf8Length(text, i));
        if (letter.empty() || (letter != kNoLetter && xmlLetter(letter) == kNoLetter)) return false;
        i += letter.size();
    }
    return true;
}

std::string xmlText(std::string_view text)
{
    std::string escaped;
    for (std::size_t i = 0; i < text.size();) {
        const std::size_t length = utf8Length(text, i);
        const std::string_view letter = text.substr(i, std::max<std::size_t>(length, 1));
        escaped += length == 0 ? kNoLetter : xmlLetter(letter);
        i += letter.size();
    }
    return escaped;
}

std::string yamlString(const std::string& text)
{
    JsonWriter json;
    json.beginArray({}, /*onOneLine=*/true);
    json.value({}, text);
    const std::string quoted = json.text().substr(1);
    std::string escaped;
    for (std::size_t i = 0; i < quoted.size();) {
        const auto found =
            std::find_if(kNotInYaml.begin(), kNotInYaml.end(), [&](const NotInYaml& letter) {
                return quoted.compare(i, letter.bytes.size(), letter.bytes) == 0;
            });
        if (found != kNotInYaml.end()) {
            escaped += found->escape;
            i += found->bytes.size();
        } else if (const int control = controlAt(quoted, i); control != 0) {
            constexpr char kHex[] = "0123456789abcdef";
            escaped += {'\\', 'u', '0', '0', kHex[control / 16], kHex[control % 16]};
            i += 2;
        } else {
            escaped += quoted[i++];
        }
    }
    return escaped;
}

std::string yamlKey(const std::string& text)
{
    std::string key = yamlString(text);
    if (key.size() > kLongestYamlKey) {
        OPENVDB_THROW(openvdb::ValueError,
            "the name that begins with '" << oneWord(std::string(startOf(text, 20))) << "' has "
                                          << text.size() << " bytes, and a key in YAML has at most "
                                          << kLongestYamlKey << " letters: give a shorter one");
    }
    return key;
}

std::string identifier(std::string_view text)
{
    std::string word;
    for (const char c : text) word += isWordLetter(c) ? c : '_';
    if (word.empty() || std::isdigit(static_cast<unsigned char>(word.front())) != 0)
        word.insert(0, "_");
    return word;
}

std::string oneWord(std::string_view text)
{
    std::string word;
    for (const char c : text) {
        const auto byte = static_cast<unsigned char>(c);
        word += byte <= 32 || byte >= 127 ? '_' : c;
    }
    return word.empty() ? "_" : word;
}

} // namespace openvdb_spheretree::detail
