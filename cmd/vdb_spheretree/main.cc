// SPDX-License-Identifier: Apache-2.0
/// @file main.cc
/// @brief vdb_spheretree: parse the whole line, check all that can be checked, run it action by
/// action.

#include "actions/Help.h"
#include "base/LastWords.h"
#include "base/Progress.h"
#include "base/Terminal.h"
#include "line/ActionParser.h"
#include "session/Session.h"

#include <openvdb/openvdb.h>
#include <openvdb/points/PointDataGrid.h>

#include <iostream>
#include <new>
#include <string>

namespace {

/// OpenVDB makes the name of a type of grid in a stream, which drops the rest where memory is lacking and says nothing.
/// Files would have the part that is left.
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

} // namespace

int main(int argc, char* argv[])
{
    using namespace command;
    holdStandardStreams();
    if (argc < 2) {
        printUsage(std::cerr);
        return kUsage;
    }
    try {
        divertLibraries();
        catchSignals();
        catchLostPages();
        initializeOpenVdb();
        const std::vector<ActionCall> line = parseLine({argv + 1, argv + argc});
        const Script script = scriptOf(line);
        Session(script.plan).run(script);
        return kOk;
    } catch (...) {
        return reportError(std::current_exception());
    }
}
