// SPDX-License-Identifier: Apache-2.0
#include "Sequence.h"

#include "base/Errors.h"
#include "expression/Expression.h"
#include "expression/FrameName.h"

#include <openvdb_spheretree/input/volume/VolumeFile.h>

#include <algorithm>
#include <filesystem>

namespace command {

namespace {

/// @return the first of several names, commas between, that has a place for the number of a frame.
std::optional<std::string> firstWithFrame(const ActionCall& call, const std::string& names)
{
    for (size_t begin = 0; begin < names.size();) {
        const size_t end = std::min(names.find(',', begin), names.size());
        const std::string name = names.substr(begin, end - begin);
        if (hasFrame(name) && !isStack(call, name)) return name;
        begin = end + 1;
    }
    return {};
}

std::string gapsIn(const std::vector<int64_t>& frames, const std::string& name)
{
    const auto there = int64_t(frames.size());
    const int64_t missing = frames.back() - frames.front() + 1 - there;
    if (missing == 0) return "";
    return "of " + oneLine(name, 200) + " there are the frames " + oneLine(rangeOfFrames(frames))
        + "; " + std::to_string(missing) + " in between " + (missing == 1 ? "is" : "are")
        + " not there";
}

/// `####` passes over `9.vdb`, which is before `0010.vdb`.
std::string shorterIn(const std::vector<int64_t>& frames, const std::string& name)
{
    const std::string before = withFrame(withAnyDigits(name), frames.front() - 1);
    std::error_code error;
    if (before == withFrame(name, frames.front() - 1) || !std::filesystem::exists(before, error)) {
        return "";
    }
    return oneLine(before, 200) + " is no frame of " + oneLine(name, 200)
        + ", as its number has fewer digits: %d takes all of them";
}

} // namespace

bool isStack(const ActionCall& call, const std::string& name)
{
    return call.spec().isSource && !call.given("frames") && openvdb_spheretree::isStackName(name);
}

std::optional<std::string> sequenceName(const ActionCall& call, const Variables& variables)
{
    if (!call.spec().isSource || !call.isOpen()) return {};
    for (const auto& one : call.given()) {
        if (!one.isOpen || one.option->name != "files") continue;
        Variables own = variables; // nothing is stored yet
        try {
            const auto name = firstWithFrame(call, evaluate(one.typed, own, nullptr));
            if (name) return name;
        } catch (const NeedsStack&) { // a name that will come from the stack
        }
    }
    return {};
}

SequenceFrames framesOfSequence(
    const ActionCall& call, const std::string& name, const Variables& variables)
{
    for (const auto& one : call.given()) {
        if (one.option->name != "frames") continue;
        Variables own = variables;
        return {framesOfRange(evaluate(one.typed, own, nullptr)), ""};
    }
    const auto frames = framesOnDisk(name);
    if (frames.empty()) {
        throwInput("no file is named like " + oneLine(name, 200) + ", with a number for its frame");
    }
    const std::string shorter = shorterIn(frames, name), gaps = gapsIn(frames, name);
    return {frames, shorter + (shorter.empty() || gaps.empty() ? "" : "; ") + gaps};
}

} // namespace command
