// SPDX-License-Identifier: Apache-2.0
/// @file SphereCsv.cc
/// @brief Strict reader of tables of spheres, line by line.

#include "SphereFormats.h"

#include <openvdb_spheretree/base/CsvTable.h>
#include <openvdb_spheretree/base/Text.h>

#include <openvdb/Exceptions.h>

#include <vector>

namespace openvdb_spheretree::detail {
namespace {

constexpr const char* kNoSphere = "the file holds no sphere";

class SphereReader {
public:
    SphereReader(std::istream& in, SphereList& spheres) : mTable(in, kNoSphere), mSpheres(spheres)
    {}

    std::string read()
    {
        const std::string assumption = readHeader();
        do {
            addSphere();
        } while (mTable.next());
        return assumption;
    }

private:
    /// Finds out what the columns are, and goes on to the first line of numbers.
    std::string readHeader()
    {
        const auto& fields = mTable.fields();
        if (!mTable.hasHeader()) {
            if (fields.size() != 4) {
                mTable.fail(
                    "a table without a header has four columns, x y z radius, and this one has "
                    + std::to_string(fields.size()) + ": put a line with their names before it");
            }
            mColumns = {SphereField::X, SphereField::Y, SphereField::Z, SphereField::Radius};
            return "it has no header: its four columns are taken as x, y, z, radius";
        }
        for (const std::string_view field : fields) mColumns.push_back(sphereFieldOf(field));
        requireColumns();
        if (!mTable.next()) throw openvdb::IoError(kNoSphere);
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
            mTable.fail(std::string("the header names ")
                + (axes[axis] ? "more than one column '" : "no column '") + "xyz"[axis] + "'");
        }
        if (radii == 0) mTable.fail("the header names no column 'radius' (or r, diameter, d)");
        if (radii > 1) mTable.fail("the header names more than one column of radii or diameters");
        if (count(SphereField::Level) > 1)
            mTable.fail("the header names more than one column 'level'");
    }

    void addSphere()
    {
        SphereEntry entry;
        for (std::size_t i = 0; i < mColumns.size(); ++i) {
            if (mColumns[i] != SphereField::None) entry[mColumns[i]] = mTable.number(i);
        }
        try {
            mSpheres.add(entry);
        } catch (const openvdb::IoError& error) {
            mTable.fail(messageOf(error));
        }
    }

    CsvTable mTable;
    SphereList& mSpheres;
    std::vector<SphereField> mColumns;
};

} // namespace

std::string parseSphereCsv(std::istream& in, SphereList& spheres)
{
    return SphereReader(in, spheres).read();
}

} // namespace openvdb_spheretree::detail
