// SPDX-License-Identifier: Apache-2.0
#include "OpenVdb.h"

#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <new>
#include <string>

namespace command {

void initializeOpenVdb()
{
    openvdb::initialize();
    const std::string last = "_5_4_3";
    for (const std::string& type : {openvdb::points::PointDataGrid::gridType(),
             openvdb::BoolGrid::gridType(), openvdb::MaskGrid::gridType(),
             openvdb::FloatGrid::gridType(), openvdb::DoubleGrid::gridType(),
             openvdb::Int32Grid::gridType(), openvdb::Int64Grid::gridType()}) {
        const bool isWhole = type.size() > last.size()
            && type.compare(type.size() - last.size(), last.size(), last) == 0;
        if (!isWhole) throw std::bad_alloc();
    }
}

} // namespace command
