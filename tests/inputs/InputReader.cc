// SPDX-License-Identifier: Apache-2.0
#include "InputReader.h"

#include "TreeUse.h"

#include <openvdb_spheretree/input/DelayedValues.h>
#include <openvdb_spheretree/input/mesh/MeshFile.h>
#include <openvdb_spheretree/input/spheres/SphereFile.h>
#include <openvdb_spheretree/input/vol/VolFile.h>
#include <openvdb_spheretree/input/volume/VolumeFile.h>
#include <openvdb_spheretree/query/QueryTables.h>

#include <base/Errors.h>
#include <expression/Expression.h>
#include <line/ActionParser.h>
#include <session/Session.h>

#include <openvdb/Exceptions.h>
#include <openvdb/Grid.h>

#include <stdexcept>

namespace spheretree_test {

using openvdb_spheretree::isSphereFileName;
using openvdb_spheretree::isVolFileName;
using openvdb_spheretree::isVolumeFileName;
using openvdb_spheretree::readMeshFile;
using openvdb_spheretree::readSphereFile;
using openvdb_spheretree::readVolFile;
using openvdb_spheretree::readVolumeFile;

namespace {

void checkMessage(const std::string& message, const std::string& path)
{
    constexpr std::size_t kLongest = 4096;
    if (message.size() > kLongest) throw std::logic_error("a message of more than 4 KiB");
    if (message.find(path) == std::string::npos) {
        throw std::logic_error("a message that does not name the file: " + message);
    }
}

/// Points of any kind may be taken for spheres; that they are none is no fault of the file.
void readAsSpheres(const openvdb::GridBase& grid)
{
    try {
        openvdb_spheretree::spheresOfPoints(grid);
    } catch (const openvdb::ValueError&) {}
}

/// Of a .raw, which says nothing of its numbers, those of the sample.
openvdb_spheretree::VolumeSettings volumeSettings()
{
    openvdb_spheretree::VolumeSettings settings;
    settings.shape = {9, 5, 10};
    settings.type = openvdb_spheretree::NumberType::UInt16;
    return settings;
}

} // namespace

bool InputReader::evaluates(const std::string& text)
{
    command::Variables variables;
    variables.set("i", "7");
    try {
        command::evaluate(text, variables, nullptr);
    } catch (const command::NeedsStack&) { // which is not there
    } catch (const command::CommandError& error) {
        if (error.code() == command::kUsage) return false;
        throw;
    }
    return true;
}

void InputReader::readVdb(bool delayed) const
{
    const auto line =
        command::parseLine({"-quiet", "-read", mFile.path(), delayed ? "delayed=1" : "delayed=0"});
    const command::Script script = command::scriptOf(line);
    command::Session session(script.plan);
    session.run(script);
    for (const auto& item : session.stack.items()) {
        if (item->tree) useTree(*item->tree);
        if (!item->grid) continue;
        try {
            openvdb_spheretree::requireReadableValues(*item->grid);
        } catch (...) {
            command::rethrowNamed(mFile.path(), command::kInput);
        }
        readAsSpheres(*item->grid);
    }
}

bool InputReader::read(const std::string& bytes, bool delayed)
{
    if (mExtension == ".expression") return evaluates(bytes);
    mFile.set(bytes);
    const std::string& path = mFile.path();
    const bool isConfig = mExtension == ".cfg";
    try {
        if (mExtension == ".vdb") readVdb(delayed);
        else if (isConfig) command::parseLine({"-config", path});
        else if (mExtension == ".poses") openvdb_spheretree::readPoseTable(path);
        else if (mExtension == ".bodies") openvdb_spheretree::readBodyPoseTable(path);
        else if (mExtension == ".points") openvdb_spheretree::readPointTable(path);
        else if (mExtension == ".rays") openvdb_spheretree::readRayTable(path);
        else if (isVolFileName(path)) readVolFile(path);
        else if (isVolumeFileName(path)) readVolumeFile(path, volumeSettings());
        else if (isSphereFileName(path)) readSphereFile(path);
        else readMeshFile(path);
        return true;
    } catch (const command::CommandError& error) {
        // Actions in the wrong order may be the fault of the line that the file is a part of.
        if (isConfig && error.code() == command::kUsage) return false;
        if (error.code() != command::kInput) throw;
        checkMessage(error.what(), path);
    } catch (const openvdb::IoError& error) { // what the readers of the library throw
        checkMessage(error.what(), path);
    }
    return false;
}

} // namespace spheretree_test
