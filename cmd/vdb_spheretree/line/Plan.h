// SPDX-License-Identifier: Apache-2.0
/// @file Plan.h
/// @brief Checks the files of a command line before any work: inputs exist and are of a known kind,
/// outputs can be written, and no two outputs go to one place.

#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace command {

/// Export: a format that other tools read, which -write knows (WriteExport.h).
enum class FileKind { Vdb, Vol, Volume, Mesh, Csv, Json, Png, Jpeg, Html, Export, Chart, Unknown };

/// @throw CommandError (input) if the file is not there, is a folder, or may not be read
void checkReadable(const std::string& path);

/// By the extension, in upper or lower case, and never Export. (A .png may be read, too: as a volume.)
FileKind fileKind(const std::string& path);
inline bool isPicture(FileKind kind) { return kind == FileKind::Png || kind == FileKind::Jpeg; }

/// @return whether @a path is `stdin.EXTENSION`, with that of a kind that is read.
bool isStdin(const std::string& path);
/// @return whether @a path is `stdout.EXTENSION`, with that of a kind that is written, or `-`.
bool isStdout(const std::string& path);

class Plan {
public:
    /// @throw CommandError (input or usage)
    void addInput(const std::string& path);
    /// @param path  a file, or one for which isStdout() holds
    /// @throw CommandError (output or usage)
    void addOutput(const std::string& path);

    /// @brief What is added from now on belongs to a frame of a loop; or to none, if @a frame is empty. Inputs of
    /// frames that are not there are kept until requireInputs(): all of them are worth knowing.
    void setFrame(const std::string& frame) { mFrame = frame; }
    const std::string& frame() const { return mFrame; }
    /// @throw CommandError (input) that names those that are not there
    void requireInputs() const;

    /// @param metres  whether what comes from a source is in metres: said by units= of -read
    void addWorldUnit(bool metres);
    /// @param typed   a length, as the value of @a option
    /// @param remedy  how the unit can be said; `@` stands for that of the length
    /// @throw CommandError (usage) if it has a unit, and not all that was read so far is in metres
    void requireKnownUnit(const std::string& option, const std::string& typed,
        const std::string& remedy =
            "say it where it is read, such as -read part.stl units=@") const;

    /// @return whether stdout carries data, so that tables and lists have to go to stderr.
    bool stdoutIsTaken() const { return mStdoutTaken; }

    /// @return whether writing @a path replaces a file that the line reads.
    bool replacesInput(const std::string& path) const;

private:
    void addFile(const std::string& path);

    /// @name Absolute paths, as far as they can be resolved
    /// @{
    std::set<std::string> mInputs;
    std::map<std::string, std::string> mOutputs; ///< and the frame of each
    /// @}
    std::string mFrame;
    std::vector<std::string> mMissing; ///< inputs of frames
    size_t mFrameInputs = 0;
    bool mStdinTaken = false, mStdoutTaken = false;
    std::optional<bool> mAllMetres; ///< nothing before the first source
};

} // namespace command
