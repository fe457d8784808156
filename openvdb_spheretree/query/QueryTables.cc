// SPDX-License-Identifier: Apache-2.0
#include "QueryTables.h"

#include <openvdb_spheretree/base/CsvTable.h>
#include <openvdb_spheretree/base/RegularFile.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>

namespace openvdb_spheretree {
namespace {

using detail::CsvTable;
using openvdb::Mat3d;
using openvdb::Vec3d;
using Names = std::vector<std::string>;
using Numbers = std::vector<double>;

const Names kPlace = {"x", "y", "z"};
const Names kQuaternion = {"qx", "qy", "qz", "qw"};
const Names kAngles = {"rx", "ry", "rz"};
const Names kRollPitchYaw = {"roll", "pitch", "yaw"}; // the same three angles, as ROS names them
const Names kTime = {"time"};
const Names kFrame = {"frame"};
const Names kBody = {"body"};
const Names kDirection = {"dx", "dy", "dz"};
const Names kMatrix = {
    "m00", "m01", "m02", "m03", "m10", "m11", "m12", "m13", "m20", "m21", "m22", "m23"};
const Names kLastRow = {"m30", "m31", "m32", "m33"};

Names operator+(Names a, const Names& b)
{
    a.insert(a.end(), b.begin(), b.end());
    return a;
}

std::string listOf(const Names& names)
{
    std::string text;
    for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
    return text;
}

/// A table whose columns are found by their names, or by how many there are.
class NamedColumns {
public:
    NamedColumns(std::istream& in, const std::string& what)
        : mWhat(what), mTable(in, "the file holds no " + what)
    {
        if (!hasHeader()) return;
        for (const std::string_view name : mTable.fields()) {
            mHeader.push_back(detail::inQuotes(name, 20));
        }
    }

    bool hasHeader() const { return mTable.hasHeader(); }
    std::size_t count() const { return mTable.fields().size(); }
    std::string lowerName(std::size_t column) const
    {
        const std::string_view field = mTable.fields()[column];
        constexpr std::size_t kLongest =
            8; // of the names above: whatever is longer is none of them
        return field.size() > kLongest ? std::string() : detail::lowerCase(field);
    }

    /// @return whether the header names one of these columns.
    bool namesAny(const Names& names) const
    {
        for (std::size_t i = 0; i < count(); ++i) {
            if (std::count(names.begin(), names.end(), lowerName(i))) return true;
        }
        return false;
    }

    /// @return the header's names of columns that take() has not taken, for people.
    std::string leftOver() const
    {
        constexpr std::size_t kMost = 5;
        Names names;
        for (std::size_t i = 0; i < mHeader.size(); ++i) {
            if (!isTaken(i)) names.push_back(mHeader[i]);
        }
        const std::size_t more = names.size() - std::min(names.size(), kMost);
        names.resize(names.size() - more);
        return listOf(names) + (more ? " and " + std::to_string(more) + " more" : "");
    }

    /// @return whether the header names a column that neither take() nor takeText() has taken.
    bool leavesOut(const std::string& name) const
    {
        for (std::size_t i = 0; i < mHeader.size(); ++i) {
            if (!isTaken(i) && detail::lowerCase(mHeader[i]) == detail::inQuotes(name)) return true;
        }
        return false;
    }

    /// Takes the columns of these names; without a header, the first of all.
    /// @throw openvdb::IoError if one is missing, or there twice
    void take(const Names& names)
    {
        for (const std::string& name : names) mColumns.push_back(place(name, names));
    }

    /// Takes a column of texts, which text() has of each line. Only of a table with a header.
    /// @param all  that such a table has, for the message
    /// @throw openvdb::IoError as take()
    void takeText(const std::string& name, const Names& all) { mText = place(name, all); }
    std::string_view text() const { return mTable.fields()[mText.value()]; }
    std::uint64_t lineNumber() const { return mTable.lineNumber(); }

    /// @return what people are told of a table without a header.
    std::string assumption(const Names& names) const
    {
        return "it has no header: its " + std::to_string(names.size()) + " columns are taken as "
            + listOf(names);
    }

    /// Calls @a add with the numbers of each line, in the order of take().
    template <typename Add>
    void forEach(const Add& add)
    {
        if (hasHeader() && !mTable.next()) throw openvdb::IoError("the file holds no " + mWhat);
        Numbers numbers(mColumns.size());
        do {
            for (std::size_t i = 0; i < numbers.size(); ++i) {
                numbers[i] = mTable.number(mColumns[i]);
                if (!std::isfinite(numbers[i])) {
                    fail(detail::inQuotes(mTable.fields()[mColumns[i]]) + " is not finite");
                }
            }
            try {
                add(numbers);
            } catch (const openvdb::ValueError& error) {
                fail(detail::messageOf(error));
            }
        } while (mTable.next());
    }

    [[noreturn]] void fail(const std::string& what) const { mTable.fail(what); }

private:
    std::size_t place(const std::string& name, const Names& all) const
    {
        if (!hasHeader()) return mColumns.size();
        std::optional<std::size_t> found;
        for (std::size_t i = 0; i < count(); ++i) {
            if (lowerName(i) != name) continue;
            if (found) fail("the header names more than one column '" + name + "'");
            found = i;
        }
        if (found) return *found;
        fail("the header names no column '" + name + "', and " + mWhat + " have " + listOf(all));
    }

    bool isTaken(std::size_t column) const
    {
        return std::count(mColumns.begin(), mColumns.end(), column) || column == mText;
    }

    std::string mWhat;
    CsvTable mTable;
    Names mHeader;                     ///< as messages show it; empty without one
    std::vector<std::size_t> mColumns; ///< of the numbers that are taken
    std::optional<std::size_t> mText;  ///< of the texts
};

Vec3d vecOf(const Numbers& numbers, std::size_t first)
{
    return Vec3d(numbers[first], numbers[first + 1], numbers[first + 2]);
}

/// Of x, y, z, w.
Mat3d rotationOfQuaternion(const Numbers& numbers, std::size_t first)
{
    constexpr double kOff = 0.01;
    double x = numbers[first], y = numbers[first + 1], z = numbers[first + 2];
    double w = numbers[first + 3];
    const double length = std::hypot(std::hypot(x, y), std::hypot(z, w));
    if (!(std::abs(length - 1) <= kOff)) {
        OPENVDB_THROW(openvdb::ValueError,
            "the quaternion qx, qy, qz, qw has length " << detail::shortNumber(length)
                                                        << ", and that of a rotation has 1");
    }
    x /= length, y /= length, z /= length, w /= length;
    return Mat3d(1 - 2 * (y * y + z * z), 2 * (x * y - z * w), 2 * (x * z + y * w), //
        2 * (x * y + z * w), 1 - 2 * (x * x + z * z), 2 * (y * z - x * w),          //
        2 * (x * z - y * w), 2 * (y * z + x * w), 1 - 2 * (x * x + y * y));
}

RigidTransform poseOfMatrix(const Numbers& numbers)
{
    std::array<double, 16> matrix = {};
    matrix[15] = 1;
    std::copy(numbers.begin(), numbers.end(), matrix.begin());
    return RigidTransform::fromMatrix(matrix);
}

/// @return the columns that say how a pose turns; none if the header names none.
/// @throw openvdb::IoError if it names two kinds
Names rotationColumns(const NamedColumns& table)
{
    Names found;
    for (const Names& names : {kMatrix, kQuaternion, kAngles, kRollPitchYaw}) {
        if (!table.namesAny(names)) continue;
        if (!found.empty()) {
            table.fail("the header names two rotations, by " + listOf(found) + " and by "
                + listOf(names) + ": leave one of them out");
        }
        found = names;
    }
    return found;
}

/// @return the columns that poses are read from.
Names poseColumns(const NamedColumns& table)
{
    if (table.hasHeader()) {
        const Names rotation = rotationColumns(table);
        if (rotation != kMatrix) return kPlace + rotation;
        if (table.namesAny(kPlace)) {
            table.fail("the header names two places, by " + listOf(kPlace)
                + " and by m03, m13, m23 of a matrix: leave one of them out");
        }
        return kMatrix + (table.namesAny(kLastRow) ? kLastRow : Names());
    }
    for (const Names& names :
        {kPlace, kPlace + kQuaternion, kTime + kPlace + kQuaternion, kMatrix, kMatrix + kLastRow}) {
        if (names.size() == table.count()) return names;
    }
    table.fail(
        "a table of poses without a header has 3 columns (x y z), 7 (x y z qx qy qz qw), 8 (a time "
        "before these), 12 or 16 (a matrix), and this one has "
        + std::to_string(table.count()) + ": put a line with their names before it");
}

RigidTransform poseOf(const Numbers& numbers, const Names& columns)
{
    if (columns.size() >= kMatrix.size()) return poseOfMatrix(numbers);
    const std::size_t place = columns.front() == kTime.front() ? 1 : 0;
    const std::size_t rotation = place + kPlace.size();
    const Vec3d move = vecOf(numbers, place);
    if (columns.size() == rotation) return RigidTransform::fromTranslation(move);
    const bool isQuaternion = columns[rotation] == kQuaternion.front();
    return RigidTransform(isQuaternion ? rotationOfQuaternion(numbers, rotation)
                                       : rotationOfAngles(vecOf(numbers, rotation)),
        move);
}

/// @return what people are told where columns of a body, or of a turn, may have been meant; empty else.
std::string notedMoves(const NamedColumns& table, const Names& names)
{
    if (table.leavesOut(kBody.front())) {
        return "its column 'body' is not used: all lines are poses of one body, "
               "and several are of a scene";
    }
    const std::string leftOver = table.leftOver();
    if (names != kPlace || leftOver.empty()) return {};
    return "its poses are moves without a turn, by x, y and z; not used: " + leftOver;
}

/// Notices angles that turn by more than once around, which were hardly meant as radians.
class LargeAngles {
public:
    explicit LargeAngles(const Names& columns)
    {
        for (const Names& names : {kAngles, kRollPitchYaw}) {
            const auto first = std::find(columns.begin(), columns.end(), names.front());
            if (first != columns.end()) mFirst = std::size_t(first - columns.begin());
        }
    }

    void see(const Numbers& numbers, std::uint64_t line)
    {
        if (!mFirst || mLine > 0) return;
        for (std::size_t i = *mFirst; i < *mFirst + 3; ++i) {
            if (!(std::abs(numbers[i]) > kFullTurn)) continue;
            mLine = line;
            mAngle = numbers[i];
            return;
        }
    }

    /// Adds a sentence to what people are told.
    void addTo(std::string& assumption) const
    {
        if (mLine == 0) return;
        assumption += (assumption.empty() ? "" : "; ")
            + std::string("its angles are taken as radians, and ") + detail::shortNumber(mAngle)
            + " of line " + std::to_string(mLine)
            + " is more than once around: degrees times 0.01745329252 are radians";
    }

private:
    std::optional<std::size_t> mFirst; ///< of the three columns
    std::uint64_t mLine = 0;           ///< of the first such angle
    double mAngle = 0;
};

/// @throw openvdb::ValueError unless a line says which body, and frames ascend
BodyPose bodyPoseOf(const NamedColumns& table, double frame, const std::vector<BodyPose>& before)
{
    constexpr double kMost = 1e15; // doubles hold all whole numbers up to there
    if (table.text().empty()) OPENVDB_THROW(openvdb::ValueError, "the line names no body");
    if (!(std::abs(frame) <= kMost) || frame != std::floor(frame)) {
        OPENVDB_THROW(openvdb::ValueError,
            "frame " << detail::shortNumber(frame) << ": frames are whole numbers");
    }
    if (!before.empty() && int64_t(frame) < before.back().frame) {
        OPENVDB_THROW(openvdb::ValueError,
            "frame " << int64_t(frame) << " stands behind frame " << before.back().frame
                     << ": put frames in ascending order");
    }
    return {int64_t(frame), std::string(table.text()), {}, table.lineNumber()};
}

/// @throw openvdb::IoError for a table without a header that has not as many columns
void requireColumns(const NamedColumns& table, const Names& names, const char* what)
{
    if (table.hasHeader() || table.count() == names.size()) return;
    table.fail(std::string("a table of ") + what + " without a header has "
        + std::to_string(names.size()) + " columns, " + listOf(names) + ", and this one has "
        + std::to_string(table.count()) + ": put a line with their names before it");
}

QueryRay rayOf(const Numbers& numbers)
{
    QueryRay ray{vecOf(numbers, 0), vecOf(numbers, 3)};
    if (ray.direction == Vec3d(0.0)) {
        OPENVDB_THROW(openvdb::ValueError, "the ray's direction has no length");
    }
    if (numbers.size() > 6) {
        ray.tNear = numbers[6];
        ray.tFar = numbers[7];
    }
    return ray;
}

/// @param fill  of the columns and the table: takes columns and adds rows; returns the names of those it took
template <typename Row, typename Fill>
QueryTable<Row> readTable(
    const std::string& path, const std::string& shownAs, const std::string& what, const Fill& fill)
{
    const std::string& name = shownAs.empty() ? path : shownAs;
    std::ifstream file = detail::openRegularFile(path, name, "a table of " + what);
    try {
        QueryTable<Row> table;
        NamedColumns columns(file, what);
        const Names names = fill(columns, table);
        if (!columns.hasHeader()) table.assumption = columns.assumption(names);
        if (!table.assumption.empty()) table.assumption = name + ": " + table.assumption;
        return table;
    } catch (const openvdb::IoError& error) {
        throw openvdb::IoError(name + ": " + detail::messageOf(error));
    } catch (const std::ios_base::failure& error) {
        throw openvdb::IoError(name + ": cannot be read: " + error.code().message());
    }
}

} // namespace

QueryTable<RigidTransform> readPoseTable(const std::string& path, const std::string& shownAs)
{
    const auto fill = [](NamedColumns& columns, QueryTable<RigidTransform>& table) {
        const Names names = poseColumns(columns);
        columns.take(names);
        LargeAngles large(names);
        columns.forEach([&](const Numbers& numbers) {
            large.see(numbers, columns.lineNumber());
            table.rows.push_back(poseOf(numbers, names));
        });
        table.assumption = notedMoves(columns, names);
        large.addTo(table.assumption);
        return names;
    };
    return readTable<RigidTransform>(path, shownAs, "poses", fill);
}

QueryTable<BodyPose> readBodyPoseTable(const std::string& path, const std::string& shownAs)
{
    const auto fill = [](NamedColumns& columns, QueryTable<BodyPose>& table) {
        if (!columns.hasHeader()) {
            columns.fail("a table of poses of bodies has a header, which names the column 'body' "
                         "among those of poses: put one before it");
        }
        const Names names = poseColumns(columns);
        columns.takeText(kBody.front(), kBody + names);
        columns.take(names);
        const bool hasFrames = columns.namesAny(kFrame);
        if (hasFrames) columns.take(kFrame);
        LargeAngles large(names);
        columns.forEach([&](const Numbers& numbers) {
            table.rows.push_back(bodyPoseOf(columns, hasFrames ? numbers.back() : 0, table.rows));
            large.see(numbers, columns.lineNumber());
            table.rows.back().pose =
                poseOf({numbers.begin(), numbers.begin() + std::ptrdiff_t(names.size())}, names);
        });
        table.assumption = notedMoves(columns, names);
        large.addTo(table.assumption);
        return names;
    };
    return readTable<BodyPose>(path, shownAs, "poses of bodies", fill);
}

QueryTable<Vec3d> readPointTable(const std::string& path, const std::string& shownAs)
{
    const auto fill = [](NamedColumns& columns, QueryTable<Vec3d>& table) {
        requireColumns(columns, kPlace, "points");
        columns.take(kPlace);
        columns.forEach([&](const Numbers& numbers) { table.rows.push_back(vecOf(numbers, 0)); });
        return kPlace;
    };
    return readTable<Vec3d>(path, shownAs, "points", fill);
}

QueryTable<QueryRay> readRayTable(const std::string& path, const std::string& shownAs)
{
    const auto fill = [](NamedColumns& columns, QueryTable<QueryRay>& table) {
        const Names bounds = {"tnear", "tfar"};
        Names names = kPlace + kDirection;
        requireColumns(columns, names, "rays");
        if (columns.hasHeader() && columns.namesAny(bounds)) names = names + bounds;
        columns.take(names);
        columns.forEach([&](const Numbers& numbers) { table.rows.push_back(rayOf(numbers)); });
        return names;
    };
    return readTable<QueryRay>(path, shownAs, "rays", fill);
}

Mat3d rotationOfAngles(const Vec3d& radians)
{
    const auto about = [&](int axis) {
        const double c = std::cos(radians[axis]), s = std::sin(radians[axis]);
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        Mat3d m = Mat3d::identity();
        m(i, i) = m(j, j) = c;
        m(i, j) = -s;
        m(j, i) = s;
        return m;
    };
    return about(2) * about(1) * about(0);
}

} // namespace openvdb_spheretree
