// SPDX-License-Identifier: Apache-2.0
/// @file SphereJson.cc
/// @brief Reader of spheres in JSON, by nlohmann-json: value by value as they come, so that memory is
/// that of the spheres, however large the file and whatever else is in it.
///
/// The array of spheres is the file itself, or a member of the object that the file is. Its first
/// entry decides whether it is one: an object with a member of a sphere, or a row of numbers below
/// `columns`, which our own trees have. All that is nested deeper is passed over.
///
/// Our own trees also announce in `levels` how many spheres each level has: one that has others is damaged.

#include "SphereFormats.h"

#include <openvdb_spheretree/base/FormatNames.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#ifdef SPHERETREE_WITH_NLOHMANN_JSON
#include <nlohmann/json.hpp>
#endif

#include <array>
#include <cmath>
#include <istream>
#include <limits>
#include <map>
#include <vector>

namespace openvdb_spheretree {

bool readsSphereJson()
{
#ifdef SPHERETREE_WITH_NLOHMANN_JSON
    return true;
#else
    return false;
#endif
}

namespace detail {

#ifdef SPHERETREE_WITH_NLOHMANN_JSON

namespace {

using Json = nlohmann::json;

/// How many spheres a tree's levels have, as the file announces it and as they come.
class LevelCounts {
public:
    /// A member of an entry of `levels`.
    void key(const std::string& name)
    {
        mMember = kMembers.size();
        for (std::size_t i = 0; i < kMembers.size(); ++i) {
            if (name == kMembers[i]) mMember = i;
        }
    }
    void value(std::optional<double> number)
    {
        if (mMember < kMembers.size()) mEntry[mMember] = number;
        mMember = kMembers.size();
    }
    void endEntry()
    {
        constexpr double kMost = std::numeric_limits<int32_t>::max();
        for (const auto& number : mEntry) {
            if (number && *number >= 0 && *number <= kMost && *number == std::floor(*number))
                continue;
            throw openvdb::IoError("an entry of 'levels' does not say which spheres the level has, "
                                   "by level, begin and end: the file is damaged");
        }
        mAnnounced[int64_t(*mEntry[0])] += int64_t(*mEntry[2]) - int64_t(*mEntry[1]);
        mEntry = {};
    }
    void add(double level) { ++mFound[int64_t(level)]; }

    /// @throw openvdb::IoError if the two differ
    void require() const
    {
        std::map<int64_t, int64_t> all = mAnnounced;
        for (const auto& level : mFound) all.emplace(level.first, 0);
        for (const auto& [level, announced] : all) {
            const auto it = mFound.find(level);
            const int64_t found = it == mFound.end() ? 0 : it->second;
            if (found == announced) continue;
            throw openvdb::IoError("level " + std::to_string(level) + " has "
                + std::to_string(found) + " spheres in the file, and 'levels' announces "
                + std::to_string(announced) + ": the file is damaged or cut, write it anew");
        }
    }

private:
    static constexpr std::array<const char*, 3> kMembers = {"level", "begin", "end"};
    std::array<std::optional<double>, 3> mEntry;
    std::size_t mMember = 3;
    std::map<int64_t, int64_t> mAnnounced, mFound; ///< SphereList::add() takes few levels
};

/// What the parser calls, one function a token. Depth counts the arrays and objects that are open.
class JsonHandler : public nlohmann::json_sax<Json> {
public:
    explicit JsonHandler(SphereList& spheres) : mSpheres(spheres) {}

    bool null() override { return value({}); }
    bool boolean(bool) override { return value({}); }
    bool number_integer(number_integer_t v) override { return value(double(v)); }
    bool number_unsigned(number_unsigned_t v) override { return value(double(v)); }
    bool number_float(number_float_t v, const string_t&) override { return value(v); }
    bool binary(binary_t&) override { return value({}); }
    bool string(string_t& text) override
    {
        if (mPlace == Place::Columns && mDepth == 2) addColumn(text);
        if (mDepth == 1 && mMember == "format") requireKnown(text);
        return value({});
    }

    bool start_object(std::size_t) override
    {
        open(false);
        return true;
    }
    bool end_object() override
    {
        close();
        return true;
    }
    bool start_array(std::size_t) override
    {
        open(true);
        return true;
    }
    bool end_array() override
    {
        close();
        return true;
    }
    bool key(string_t& name) override
    {
        if (mDepth == 3 && mMember == "levels") mCounts.key(name);
        if (mDepth == 1) {
            mMember = onOneLine(name, 60);
            mIsColumns = name == "columns";
        } else if (isInEntry()) {
            mField = sphereFieldOf(name);
            mIsCenter = name == "center" || name == "centre";
        }
        return true;
    }
    bool parse_error(std::size_t at, const std::string&, const Json::exception& error) override
    {
        const std::string_view why = error.what();
        throw openvdb::IoError("byte " + std::to_string(at) + ": this is no sound JSON ("
            + onOneLine(why.substr(why.find("] ") == why.npos ? 0 : why.find("] ") + 2), 200)
            + ")");
    }

    /// Does the file say that it is a tree of ours?
    bool isOurs() const { return mIsOurs; }

    /// To be called when all is read.
    void requireCounts() const
    {
        if (mIsOurs) mCounts.require();
    }

private:
    /// What the innermost array or object is that matters; all inside of it that does not is passed
    /// over.
    enum class Place { Outside, Columns, List, Entry, Row, Center };

    bool isInEntry() const { return mPlace == Place::Entry && mDepth == mListDepth + 1; }

    void open(bool isArray)
    {
        constexpr int kDeepest = 512;
        if (++mDepth > kDeepest) throw openvdb::IoError("it is nested deeper than 512");
        if (mDepth == 1) mIsArray = isArray;
        if (mPlace == Place::Outside && isArray && (mDepth == 1 || (mDepth == 2 && !mIsArray))) {
            openList();
        } else if (mPlace == Place::List && mDepth == mListDepth + 1) {
            if (mSkipped) return;
            if (isArray && mColumns.empty()) return passOver();
            mPlace = isArray ? Place::Row : Place::Entry;
            ++mEntries;
            mEntry = {};
            mColumn = 0;
            mField = SphereField::None;
            mIsCenter = false;
        } else if (isInEntryAt(mListDepth + 2) && isArray && mIsCenter) {
            mPlace = Place::Center;
            mColumn = 0;
        }
    }
    bool isInEntryAt(int depth) const { return mPlace == Place::Entry && mDepth == depth; }

    void openList()
    {
        mListDepth = mDepth;
        mEntries = 0;
        mSkipped = false;
        if (mIsColumns && mDepth == 2) {
            mPlace = Place::Columns;
            mColumns.clear();
        } else {
            mPlace = Place::List;
        }
    }

    void close()
    {
        const int depth = mDepth--;
        if (mIsOurs && depth == 3 && mMember == "levels") mCounts.endEntry();
        if (mPlace == Place::Center && depth == mListDepth + 2) {
            if (mColumn != 3) fail("the centre has " + std::to_string(mColumn) + " coordinates");
            mPlace = Place::Entry;
            mIsCenter = false;
        } else if ((mPlace == Place::Entry || mPlace == Place::Row) && depth == mListDepth + 1) {
            finishEntry();
            mPlace = Place::List;
        } else if ((mPlace == Place::List || mPlace == Place::Columns) && depth == mListDepth) {
            mPlace = Place::Outside;
        }
    }

    void finishEntry()
    {
        const bool isOther = mPlace == Place::Row && mColumn != mColumns.size();
        if (mEntries == 1 && (isOther || !mEntry.any())) {
            mSkipped = true; // an array of something else, such as the edges of a DAG
            return;
        }
        if (isOther) {
            fail("it has " + std::to_string(mColumn) + " values, and there are "
                + std::to_string(mColumns.size()) + " columns");
        }
        if (mEntries == 1 && mSpheres.size() > 0) fail("there is more than one array of spheres");
        try {
            mSpheres.add(mEntry);
            if (const auto level = mEntry[SphereField::Level]) mCounts.add(*level);
        } catch (const openvdb::IoError& error) {
            fail(messageOf(error));
        }
    }

    bool value(std::optional<double> number)
    {
        if (mDepth == 3 && mMember == "levels") mCounts.value(number);
        if (mPlace == Place::Center && mDepth == mListDepth + 2) {
            if (!number) fail("a coordinate of the centre is no number");
            if (mColumn < 3) {
                if (mEntry.values[mColumn]) fail("it has a centre twice");
                mEntry.values[mColumn] = *number;
            }
            ++mColumn;
        } else if (mPlace == Place::Row && mDepth == mListDepth + 1) {
            if (mColumn < mColumns.size()) set(mColumns[mColumn], number);
            ++mColumn;
        } else if (isInEntry()) {
            set(mField, number);
        } else if (mPlace == Place::List && mDepth == mListDepth) {
            passOver();
        }
        return true;
    }

    /// An entry of a list that is no sphere: among spheres it is an error, and an array of such is something else.
    void passOver()
    {
        if (mSkipped) return;
        if (mEntries == 0) {
            mSkipped = true;
            return;
        }
        ++mEntries;
        fail("it is no sphere");
    }

    void set(SphereField field, std::optional<double> number)
    {
        if (field == SphereField::None) return;
        if (!number) fail("what should be a number is none");
        if (mEntry[field]) fail("it has the same member twice");
        mEntry[field] = number;
    }

    /// Our own trees say which version of the format they have.
    void requireKnown(const std::string& format)
    {
        const std::string ours = std::string(kTreeJsonName) + '.', known = treeJsonFormat();
        mIsOurs = format == known;
        if (format.compare(0, ours.size(), ours) != 0 || mIsOurs) return;
        throw openvdb::IoError(
            "its format is " + inQuotes(format) + ", and this version reads " + known);
    }

    void addColumn(const std::string& name)
    {
        constexpr std::size_t kMost = 4096;
        if (mColumns.size() == kMost) throw openvdb::IoError("there are more than 4096 columns");
        mColumns.push_back(sphereFieldOf(name));
    }

    std::string where() const
    {
        const std::string list = mListDepth == 1 ? "" : " of '" + mMember + "'";
        return "entry " + std::to_string(mEntries) + list;
    }
    [[noreturn]] void fail(const std::string& what) const
    {
        throw openvdb::IoError(where() + ": " + what);
    }

    SphereList& mSpheres;
    int mDepth = 0, mListDepth = 0;
    bool mIsArray = false;   ///< is the file an array?
    std::string mMember;     ///< of the file's object: the one that is read
    bool mIsColumns = false; ///< is that the list of columns?
    Place mPlace = Place::Outside;
    std::vector<SphereField> mColumns;
    std::uint64_t mEntries = 0; ///< of the array so far, counted from 1
    bool mIsOurs = false;       ///< does the file say that it is a tree of ours?
    LevelCounts mCounts;
    bool mSkipped = false; ///< the array is of something else
    SphereEntry mEntry;
    SphereField mField = SphereField::None; ///< of the entry's member
    bool mIsCenter = false;
    std::size_t mColumn = 0; ///< values of the row or of the centre so far
};

} // namespace

void parseSphereJson(std::istream& in, SphereList& spheres)
{
    JsonHandler handler(spheres);
    Json::sax_parse(in, &handler);
    handler.requireCounts();
    if (spheres.size() == 0 && !handler.isOurs()) {
        throw openvdb::IoError(
            "it holds no sphere: they are taken from a list of objects with x, y, z (or center) "
            "and radius, or from rows below 'columns'; those of foam and MorphIt are not read");
    }
}

#else

void parseSphereJson(std::istream&, SphereList&)
{
    throw openvdb::IoError(
        "this build reads spheres from .csv only; for .json install nlohmann-json (Debian: "
        "nlohmann-json3-dev) and configure with -DSPHERETREE_WITH_NLOHMANN_JSON=ON");
}

#endif

} // namespace detail

} // namespace openvdb_spheretree
