// SPDX-License-Identifier: Apache-2.0
#include "Actions.h"

#include <openvdb_spheretree/base/Text.h>

namespace command {

const std::vector<ActionSpec>& actionTable()
{
    static const std::vector<ActionSpec> table = {readAction(), generateAction(), mesh2lsAction(),
        resampleAction(), maskAction(), spheretreeAction(), statsAction(), checkAction(),
        collideAction(), distanceAction(), raycastAction(), containsAction(), levelAction(),
        spheres2maskAction(), spheres2lsAction(), writeAction(), printAction(), forAction(),
        eachAction(), filesAction(), ifAction(), endAction(), onerrorAction(), evalAction(),
        defaultAction(), configAction(), clearAction(), threadsAction(), quietAction(),
        verboseAction(), debugAction(), helpAction(), versionAction(), examplesAction()};
    return table;
}

const ActionSpec* findAction(const std::string& name)
{
    const std::string alias = openvdb_spheretree::detail::lowerCase(name); // -V is as usual as -v
    for (const ActionSpec& action : actionTable()) {
        if (action.name == name || (!name.empty() && action.alias == alias)) return &action;
    }
    return nullptr;
}

} // namespace command
