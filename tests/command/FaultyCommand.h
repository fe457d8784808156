// SPDX-License-Identifier: Apache-2.0
/// @file FaultyCommand.h
/// @brief For tests of what the command does when the system fails: faults at chosen system calls
/// (`shim/FaultShim.cc`), and what must hold of the files whatever happens.

#pragma once

#include "CommandRunner.h"

#include <map>

namespace command_test {

/// @name Faults, to be joined by `;`. Calls are named in the shim, and counted from 1.
/// @{
/// From the n-th call on, calls fail with this errno.
std::string failing(const std::string& call, long n, int error);
/// Only the n-th call fails.
std::string failingOnce(const std::string& call, long n, int error);
/// Only half of what the n-th write is given is written.
std::string halved(long n);
/// A signal comes just before the n-th call.
std::string signalled(const std::string& call, long n, int signal);
/// The n-th call takes so many seconds, whatever signals come.
std::string hanging(const std::string& call, long n, int seconds);
/// No file without a name, as on network file systems.
std::string namedFilesOnly();
/// @}

/// @return @a most numbers from 1 to @a last at equal distances, both ends among them; all, if there
///         are no more.
std::vector<long> spread(long last, long most);

class FaultyCommandTest : public CommandTest {
protected:
    /// Makes `tree.vdb`, a tree with edges, and `a.vol`, the object that it is of.
    void SetUp() override;

    Running startWith(const std::string& arguments, const std::string& faults,
        const std::string& input = "/dev/null") const;
    Result runWith(const std::string& arguments, const std::string& faults) const
    {
        return startWith(arguments, faults).wait();
    }

    /// On a machine that says it has no more memory than this.
    Result runWithin(long mebibytes, const std::string& arguments) const;

    /// @return how often a line that succeeds makes each call.
    std::map<std::string, long> callsOf(
        const std::string& arguments, const std::string& faults = "");

    /// @return those files that only a killed run may leave.
    std::vector<std::string> leftovers() const;

    /// Puts "precious" where a line will write, and notes what files there are.
    void writeOld(const std::vector<std::string>& names);
    bool isOld(const std::string& name) const { return readText(path(name)) == "precious"; }

    /// Holds a failed run against what is asked of all: its code, words in its message, old targets
    /// as they were, no other files than before.
    void expectFailure(const Result& result, int code, const std::vector<std::string>& words,
        const std::vector<std::string>& targets) const;

    std::vector<std::string> mBefore; ///< files after SetUp(), or the last writeOld()
};

} // namespace command_test
