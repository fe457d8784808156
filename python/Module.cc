// SPDX-License-Identifier: Apache-2.0
/// @file Module.cc
/// @brief spheretree._spheretree: arrays and handles, for the package beside it, which has the functions that
/// people call, their keywords and their documentation.

#include "Errors.h"
#include "Tree.h"
#include "Volume.h"

#include "base/OpenVdb.h"

#include <pybind11/pybind11.h>

PYBIND11_MODULE(_spheretree, module)
{
    command::initializeOpenVdb();
    module.doc() = "What the package spheretree calls. Not for use by itself.";
    module.attr("version") = SPHERETREE_VERSION;
    binding::bindErrors(module);
    binding::bindVolume(module);
    binding::bindTree(module);
    binding::bindTreeFiles(module);
    binding::bindTreeExport(module);
    binding::bindTreePage(module);
    binding::bindBuild(module);
    binding::bindTransforms(module);
    binding::bindPoints(module);
    binding::bindQuery(module);
    binding::bindScene(module);
}
