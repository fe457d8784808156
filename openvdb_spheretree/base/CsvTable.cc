// SPDX-License-Identifier: Apache-2.0
#include "CsvTable.h"

#include "Text.h"

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <istream>
#include <optional>

namespace openvdb_spheretree::detail {
namespace {

constexpr std::string_view kBlanks = " \t\r\f\v";
constexpr std::size_t kLongestLine = std::size_t(1) << 16;
constexpr std::size_t kMostColumns = 4096;

/// @return the text without blanks around it, and without quotes around that.
std::string_view trimmed(std::string_view text)
{
    const std::size_t first = text.find_first_not_of(kBlanks);
    if (first == text.npos) return {};
    text = text.substr(first, text.find_last_not_of(kBlanks) - first + 1);
    if (text.size() >= 2 && text.front() == '"' && text.back() == '"') {
        text = text.substr(1, text.size() - 2);
    }
    return text;
}

std::optional<double> numberIn(std::string_view text)
{
    if (text.size() > 1 && text[0] == '+' && text[1] != '-') text.remove_prefix(1);
    return parseNumber<double>(text);
}

/// @return whether a field looks like a name, and not like a number that is damaged or left out.
bool isName(std::string_view field)
{
    if (field.empty() || numberIn(field)) return false;
    const auto first = static_cast<unsigned char>(field.front());
    return std::isalpha(first) != 0 || first == '_' || first >= 0x80;
}

/// @return what is wrong with a field that is no number, and what to do.
std::string whyNoNumber(std::string_view field, std::size_t column)
{
    if (field.empty())
        return "column " + std::to_string(column + 1) + " is empty, and holds a number elsewhere";
    double number = 0;
    const std::string_view digits = field.substr(field.front() == '+' ? 1 : 0);
    const char* const end = digits.data() + digits.size();
    const auto [stop, error] = std::from_chars(digits.data(), end, number);
    if (error == std::errc::result_out_of_range && stop == end)
        return inQuotes(field) + " is beyond the range of doubles, 5e-324 to 1.8e308";
    return inQuotes(field) + " is no number: write it in decimal, as 0.5 or 5e-1";
}

/// @return where the first of some characters is that stands in no quotes.
std::size_t outsideQuotes(std::string_view text, std::string_view characters)
{
    bool quoted = false;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] == '"') quoted = !quoted;
        else if (!quoted && characters.find(text[i]) != characters.npos) return i;
    }
    return text.npos;
}

char separatorOf(const std::string& line)
{
    for (const char separator : {';', ',', '\t'}) {
        if (outsideQuotes(line, std::string_view(&separator, 1)) != line.npos) return separator;
    }
    return ' ';
}

} // namespace

CsvTable::CsvTable(std::istream& in, const std::string& noLines)
    : mIn(in), mBuffer(kLongestLine + 2)
{
    if (!findLine()) throw openvdb::IoError(noLines);
    mSeparator = separatorOf(mLine);
    split();
    mColumns = mFields.size();
    mHasHeader = std::any_of(mFields.begin(), mFields.end(), isName);
}

bool CsvTable::next()
{
    if (!findLine()) return false;
    split();
    if (mFields.size() != mColumns) {
        fail("it has " + std::to_string(mFields.size()) + " columns, and the first line has "
            + std::to_string(mColumns));
    }
    return true;
}

double CsvTable::number(std::size_t column) const
{
    const auto value = numberIn(mFields[column]);
    if (!value) fail(whyNoNumber(mFields[column], column));
    return *value;
}

void CsvTable::fail(const std::string& what) const
{
    throw openvdb::IoError("line " + std::to_string(mNumber) + ": " + what);
}

/// Goes to the next line that is not skipped. @return false at the end
bool CsvTable::findLine()
{
    while (readLine()) {
        const std::string_view text = trimmed(mLine);
        if (!text.empty() && text[0] != '#') return true;
    }
    return false;
}

/// As std::getline(), but a line has an end; and without the mark that spreadsheets begin their tables with.
bool CsvTable::readLine()
{
    ++mNumber;
    mIn.getline(mBuffer.data(), std::streamsize(mBuffer.size()));
    const auto count = std::size_t(mIn.gcount()); // with the line's end, where it has one
    if (mIn.fail() && count + 1 == mBuffer.size()) fail("it is longer than 65536 characters");
    if (count == 0 || mIn.bad()) return false;
    mLine.assign(mBuffer.data(), mIn.eof() ? count : count - 1);
    if (mLine.find('\0') != mLine.npos || mLine.compare(0, 2, "\xFF\xFE") == 0
        || mLine.compare(0, 2, "\xFE\xFF") == 0) {
        fail("it is not the text of a table; if that is in UTF-16, save it as UTF-8");
    }
    if (mNumber == 1 && mLine.compare(0, 3, "\xEF\xBB\xBF") == 0) mLine.erase(0, 3);
    return true;
}

/// Cuts the line into mFields. Many blanks separate as one does.
void CsvTable::split()
{
    mFields.clear();
    const std::string_view separators =
        mSeparator == ' ' ? kBlanks : std::string_view(&mSeparator, 1);
    std::string_view rest = mLine;
    while (true) {
        if (mSeparator == ' ') {
            rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
            if (rest.empty()) return;
        }
        const std::size_t end = outsideQuotes(rest, separators);
        mFields.push_back(trimmed(rest.substr(0, end)));
        if (mFields.size() > kMostColumns) fail("it has more than 4096 columns");
        if (end == rest.npos) return;
        rest.remove_prefix(end + 1);
    }
}

} // namespace openvdb_spheretree::detail
