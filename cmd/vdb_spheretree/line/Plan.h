// SPDX-License-Identifier: Apache-2.0
/// @file Plan.h
/// @brief The files of a command line, looked at before any work: inputs are there and of a known
/// kind, outputs can be written, and nothing is written to one place twice.

#pragma once

#include <set>
#include <string>

namespace command {

enum class FileKind { Vdb, Vol, Mesh, Csv, Json, Png, Unknown };

/// @return `.vdb` of `path/Tree.VDB`.
std::string extensionOf(const std::string& path);

/// By extension, in any case.
FileKind fileKind(const std::string& path);

class Plan {
public:
    /// @throw CommandError (input or usage)
    void addInput(const std::string& path);
    /// @param path  a file, or `stdout.vdb`, or `-` for text on stdout
    /// @throw CommandError (output or usage)
    void addOutput(const std::string& path);

    /// @return whether stdout carries data, so that tables and lists have to go to stderr.
    bool stdoutIsTaken() const { return mStdoutTaken; }

private:
    std::set<std::string> mOutputs; ///< as absolute paths, as far as they can be resolved
    bool mStdinTaken = false, mStdoutTaken = false;
};

} // namespace command
