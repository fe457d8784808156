// SPDX-License-Identifier: Apache-2.0
#include "InputReader.h"

#include "MemoryLimit.h"
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

#include <optional>
#include <stdexcept>
#include <string_view>

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

/// @return the same turn for the same bytes: a finding is one again when its file alone is tried.
uint64_t turnOf(const std::string& bytes) { return std::hash<std::string_view>()(bytes); }

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

InputReader::InputReader(const std::string& extension, TreeUses uses)
    : mExtension(extension), mFile(extension), mUses(uses)
{
    if (VolumeInput::isKind(extension)) mVolume.emplace(extension);
}

void InputReader::limit(const ReadingLimit& reading)
{
    mLimit = reading;
    mBefore = bytesOfAddresses();
}

void InputReader::readVdb(const std::string& bytes, bool delayed) const
{
    const auto line =
        command::parseLine({"-quiet", "-read", mFile.path(), delayed ? "delayed=1" : "delayed=0"});
    const command::Script script = command::scriptOf(line);
    command::Session session(script.plan);
    {
        const MemoryLimit reading(allowed(bytes.size()));
        session.run(script);
        for (const auto& item : session.stack.items()) {
            if (item->grid) readValues(*item->grid);
        }
    }
    for (const auto& item : session.stack.items()) {
        const openvdb_spheretree::SphereTree* const tree = item->anyTree();
        if (!tree) continue;
        const uint64_t first = turnOf(bytes);
        const uint64_t count = mUses == TreeUses::All ? kUseTurns : 1;
        for (uint64_t turn = first; turn < first + count; ++turn) useTree(*tree, turn);
    }
}

void InputReader::readValues(const openvdb::GridBase& grid) const
{
    try {
        openvdb_spheretree::requireReadableValues(grid);
    } catch (...) {
        command::rethrowNamed(mFile.path(), command::kInput);
    }
    readAsSpheres(grid);
}

void InputReader::readOther(const std::string& bytes) const
{
    const std::string& path = mFile.path();
    const MemoryLimit reading(allowed(bytes.size()));
    if (mVolume) mVolume->read();
    else if (mExtension == ".cfg") command::parseLine({"-config", path});
    else if (mExtension == ".poses") openvdb_spheretree::readPoseTable(path);
    else if (mExtension == ".bodies") openvdb_spheretree::readBodyPoseTable(path);
    else if (mExtension == ".points") openvdb_spheretree::readPointTable(path);
    else if (mExtension == ".rays") openvdb_spheretree::readRayTable(path);
    else if (isVolFileName(path)) readVolFile(path);
    else if (isVolumeFileName(path)) readVolumeFile(path);
    else if (isSphereFileName(path)) readSphereFile(path);
    else readMeshFile(path);
}

uint64_t InputReader::allowed(std::size_t fileBytes) const
{
    return mLimit.bytes ? mBefore + mLimit.bytes + mLimit.perByte * fileBytes : 0;
}

bool InputReader::read(const std::string& bytes, bool delayed)
{
    if (mExtension == ".expression") return evaluates(bytes);
    if (mVolume) mVolume->set(bytes);
    else mFile.set(bytes);
    const std::string& path = mVolume ? mVolume->path() : mFile.path();
    const bool isConfig = mExtension == ".cfg";
    try {
        if (mExtension == ".vdb") readVdb(bytes, delayed);
        else readOther(bytes);
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
