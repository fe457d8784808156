// SPDX-License-Identifier: Apache-2.0
#include "FaultyCommand.h"

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <fstream>

namespace command_test {

namespace {

std::string faultOf(const std::string& call, long n, const std::string& effect, int number)
{
    return call + ":" + std::to_string(n) + ":" + effect + ":" + std::to_string(number);
}

/// In the child: has the library loaded that makes calls fail.
void prepare(const std::string& faults, const std::string& counts)
{
    setenv("SPHERETREE_FAULTS", faults.c_str(), 1);
    if (!counts.empty()) setenv("SPHERETREE_FAULT_COUNTS", counts.c_str(), 1);
    setenv("LD_PRELOAD", SPHERETREE_FAULT_SHIM, 1);
}

} // namespace

std::string failing(const std::string& call, long n, int error)
{
    return faultOf(call, n, "error", error);
}

std::string failingOnce(const std::string& call, long n, int error)
{
    return faultOf(call, n, "once", error);
}

std::string halved(long n) { return faultOf("write", n, "part", 0); }

std::string signalled(const std::string& call, long n, int signal)
{
    return faultOf(call, n, "signal", signal);
}

std::string hanging(const std::string& call, long n, int seconds)
{
    return faultOf(call, n, "hang", seconds);
}

std::string namedFilesOnly() { return failing("tmpfile", 1, EOPNOTSUPP); }

std::vector<long> spread(long last, long most)
{
    std::vector<long> numbers;
    const long count = std::min(last, most);
    for (long i = 0; i < count; ++i) {
        numbers.push_back(count == 1 ? last : 1 + i * (last - 1) / (count - 1));
    }
    return numbers;
}

void FaultyCommandTest::SetUp()
{
    CommandTest::SetUp();
    writeBlock("a.vol");
    const Result made = run("-read a.vol -spheretree tree=extended dag=1 -write tree.vdb");
    ASSERT_EQ(made.exitCode, 0) << made.err;
    mBefore = files();
}

Running FaultyCommandTest::startWith(
    const std::string& arguments, const std::string& faults, const std::string& input) const
{
    return start(split(arguments), input, [faults] { prepare(faults, ""); });
}

Result FaultyCommandTest::runWithin(long mebibytes, const std::string& arguments) const
{
    return start(split(arguments), "/dev/null", [=] {
        setenv("SPHERETREE_FAULT_MEMORY", std::to_string(mebibytes).c_str(), 1);
        prepare("", "");
    }).wait();
}

std::map<std::string, long> FaultyCommandTest::callsOf(
    const std::string& arguments, const std::string& faults)
{
    const std::string counts = (mFolder / "counts").string();
    const Result result =
        start(split(arguments), "/dev/null", [=] { prepare(faults, counts); }).wait();
    EXPECT_EQ(result.exitCode, 0) << arguments << "\n" << result.err;
    std::map<std::string, long> calls;
    std::ifstream in(counts);
    std::string call;
    for (long number = 0; in >> call >> number;) calls[call] = number;
    EXPECT_FALSE(calls.empty());
    return calls;
}

std::vector<std::string> FaultyCommandTest::leftovers() const
{
    std::vector<std::string> names = files();
    const auto isNone = [](const std::string& name) {
        return name[0] != '.' || name.find(".vdb_spheretree-tmp.") == std::string::npos;
    };
    names.erase(std::remove_if(names.begin(), names.end(), isNone), names.end());
    return names;
}

void FaultyCommandTest::writeOld(const std::vector<std::string>& names)
{
    for (const std::string& name : names) writeText(path(name), "precious");
    mBefore = files();
}

void FaultyCommandTest::expectFailure(const Result& result, int code,
    const std::vector<std::string>& words, const std::vector<std::string>& targets) const
{
    EXPECT_EQ(result.exitCode, code) << result.err;
    for (const std::string& word : words) {
        EXPECT_NE(result.err.find(word), std::string::npos) << word << "\n" << result.err;
    }
    for (const std::string& target : targets) EXPECT_TRUE(isOld(target)) << target;
    EXPECT_EQ(files(), mBefore);
}

} // namespace command_test
