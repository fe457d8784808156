// SPDX-License-Identifier: Apache-2.0
/// @file main.cc
/// @brief vdb_spheretree: parse the whole line, check all that can be checked, run it action by
/// action.

#include "actions/Help.h"
#include "base/LastWords.h"
#include "base/OpenVdb.h"
#include "base/Progress.h"
#include "base/Terminal.h"
#include "line/ActionParser.h"
#include "session/Session.h"

#include <iostream>

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
