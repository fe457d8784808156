// SPDX-License-Identifier: Apache-2.0
/// @file SphereCsv.cc
/// @brief Strict reader of tables of spheres, line by line.
///
/// The first line that is not skipped decides: its first semicolon, comma or tab is what separates
/// columns, in this order, or else blanks; and it is a header if one of its fields is no number.

#include "SphereFormats.h"

#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <istream>
#include <vector>

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

class CsvReader {
public:
    CsvReader(std::istream& in, SphereList& spheres) : mIn(in), mSpheres(spheres) {}

    std::string read()
    {
        if (!nextLine()) throw openvdb::IoError("the file holds no sphere");
        mSeparator = separatorOf(mLine);
        split();
        const std::string assumption = readHeader();
        addSphere();
        while (nextLine()) {
            split();
            addSphere();
        }
        return assumption;
    }

private:
    /// Goes to the next line that is not skipped. @return false at the end
    bool nextLine()
    {
        while (readLine()) {
            const std::string_view text = trimmed(mLine);
            if (!text.empty() && text[0] != '#') return true;
        }
        return false;
    }

    /// As std::getline(), but a line has an end.
    bool readLine()
    {
        ++mNumber;
        mIn.getline(mBuffer.data(), std::streamsize(mBuffer.size()));
        const auto count = std::size_t(mIn.gcount()); // with the line's end, where it has one
        if (mIn.fail() && count + 1 == mBuffer.size()) fail("it is longer than 65536 characters");
        if (count == 0 || mIn.bad()) return false;
        mLine.assign(mBuffer.data(), mIn.eof() ? count : count - 1);
        return dropByteOrderMark();
    }

    /// Spreadsheets begin their tables with one.
    bool dropByteOrderMark()
    {
        if (mNumber == 1 && mLine.compare(0, 3, "\xEF\xBB\xBF") == 0) mLine.erase(0, 3);
        return true;
    }

    static char separatorOf(const std::string& line)
    {
        for (const char separator : {';', ',', '\t'}) {
            if (outsideQuotes(line, std::string_view(&separator, 1)) != line.npos) return separator;
        }
        return ' ';
    }

    /// @return where the first of some characters is that stands in no quotes.
    static std::size_t outsideQuotes(std::string_view text, std::string_view characters)
    {
        bool quoted = false;
        for (std::size_t i = 0; i < text.size(); ++i) {
            if (text[i] == '"') quoted = !quoted;
            else if (!quoted && characters.find(text[i]) != characters.npos) return i;
        }
        return text.npos;
    }

    /// Cuts the line into mFields. Many blanks separate as one does.
    void split()
    {
        mFields.clear();
        std::string_view rest = mLine;
        while (true) {
            if (mSeparator == ' ') {
                rest.remove_prefix(std::min(rest.find_first_not_of(kBlanks), rest.size()));
                if (rest.empty()) return;
            }
            const std::size_t end =
                outsideQuotes(rest, mSeparator == ' ' ? kBlanks : std::string_view(&mSeparator, 1));
            mFields.push_back(trimmed(rest.substr(0, end)));
            if (mFields.size() > kMostColumns) fail("it has more than 4096 columns");
            if (end == rest.npos) return;
            rest.remove_prefix(end + 1);
        }
    }

    /// Finds out what the columns are, and goes on to the first line of numbers.
    std::string readHeader()
    {
        bool isHeader = false;
        for (const std::string_view field : mFields) isHeader = isHeader || !numberIn(field);
        if (!isHeader) {
            if (mFields.size() != 4) {
                fail("a table without a header has four columns, x y z radius, and this one has "
                    + std::to_string(mFields.size()) + ": put a line with their names before it");
            }
            mColumns = {SphereField::X, SphereField::Y, SphereField::Z, SphereField::Radius};
            return "it has no header: its four columns are taken as x, y, z, radius";
        }
        for (const std::string_view field : mFields) mColumns.push_back(sphereFieldOf(field));
        requireColumns();
        if (!nextLine()) throw openvdb::IoError("the file holds no sphere");
        split();
        return {};
    }

    void requireColumns() const
    {
        const auto count = [&](SphereField field) {
            int found = 0;
            for (const SphereField column : mColumns) found += column == field;
            return found;
        };
        const int radii = count(SphereField::Radius) + count(SphereField::Diameter);
        const int axes[] = {count(SphereField::X), count(SphereField::Y), count(SphereField::Z)};
        for (int axis = 0; axis < 3; ++axis) {
            if (axes[axis] == 1) continue;
            fail(std::string("the header names ")
                + (axes[axis] ? "more than one column '" : "no column '") + "xyz"[axis] + "'");
        }
        if (radii == 0) fail("the header names no column 'radius' (or r, diameter, d)");
        if (radii > 1) fail("the header names more than one column of radii or diameters");
        if (count(SphereField::Level) > 1) fail("the header names more than one column 'level'");
    }

    void addSphere()
    {
        if (mFields.size() != mColumns.size()) {
            fail("it has " + std::to_string(mFields.size()) + " columns, and the first line has "
                + std::to_string(mColumns.size()));
        }
        SphereEntry entry;
        for (std::size_t i = 0; i < mFields.size(); ++i) {
            if (mColumns[i] == SphereField::None) continue;
            entry[mColumns[i]] = numberIn(mFields[i]);
            if (!entry[mColumns[i]]) fail(inQuotes(mFields[i]) + " is no number");
        }
        try {
            mSpheres.add(entry);
        } catch (const openvdb::IoError& error) {
            fail(messageOf(error));
        }
    }

    std::string where() const { return "line " + std::to_string(mNumber); }
    [[noreturn]] void fail(const std::string& what) const
    {
        throw openvdb::IoError(where() + ": " + what);
    }

    std::istream& mIn;
    SphereList& mSpheres;
    std::vector<char> mBuffer = std::vector<char>(kLongestLine + 2);
    std::string mLine;
    std::uint64_t mNumber = 0;
    char mSeparator = ',';
    std::vector<std::string_view> mFields; ///< of the line
    std::vector<SphereField> mColumns;
};

} // namespace

std::string parseSphereCsv(std::istream& in, SphereList& spheres)
{
    return CsvReader(in, spheres).read();
}

} // namespace openvdb_spheretree::detail
