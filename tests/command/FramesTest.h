// SPDX-License-Identifier: Apache-2.0
/// @file FramesTest.h
/// @brief Frames of balls to read, and whether files of frames are there.

#pragma once

#include "CommandRunner.h"

#include <openvdb/openvdb.h>

#include <algorithm>
#include <string>
#include <vector>

namespace command_test {

class CommandFrames : public CommandTest {
protected:
    /// Balls of radius @a frame, and an empty grid where the frame is @a empty.
    void writeFrames(const std::vector<int>& frames, int empty = -1) const
    {
        for (const int frame : frames) {
            auto grid = sphereGrid("density", float(frame));
            if (frame == empty) grid->clear();
            writeGrids(nameOf("smoke", frame, "vdb"), {grid});
        }
    }

    void writeLargerVoxels(const std::string& name) const
    {
        auto grid = sphereGrid("density", 10);
        grid->setTransform(openvdb::math::Transform::createLinearTransform(0.25));
        writeGrids(name, {grid});
    }

    static std::string nameOf(const std::string& name, int frame, const std::string& extension)
    {
        const std::string digits = std::to_string(frame);
        return name + "_" + std::string(4 - digits.size(), '0') + digits + "." + extension;
    }

    bool existAll(const std::string& name, const std::vector<int>& frames,
        const std::string& extension = "vdb") const
    {
        return std::all_of(frames.begin(), frames.end(),
            [&](int frame) { return exists(nameOf(name, frame, extension)); });
    }
};

inline bool holds(const std::string& text, const std::string& part)
{
    return text.find(part) != std::string::npos;
}

} // namespace command_test
