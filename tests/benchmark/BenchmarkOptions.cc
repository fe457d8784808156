// SPDX-License-Identifier: Apache-2.0
#include "BenchmarkOptions.h"

#include <sstream>
#include <stdexcept>

namespace spheretree_benchmark {

const char* const kBenchmarkUsage =
    R"(usage: spheretree_benchmark [--objects=NAME,...] [--largest] [--more] [--json=FILE]
                            [--benchmark_filter=REGEX] [--benchmark_min_time=SECONDS]

  --objects   these in place of the usual ones: SHAPE-VOXELS, such as gyroid-1e6, or NAME of
              $SPHERETREE_DATA/vol/NAME.vol or vdb/NAME.vdb
  --largest   objects of more than a million leaf nodes, too: minutes, and gigabytes
  --more      stages that only those who work on them want to see, too
  --json      the numbers as JSON, too
  --benchmark_filter, --benchmark_min_time and all others of Google Benchmark: which of
              OBJECT/STAGE/threads:N to run, and for how long each (0.5)
)";

namespace {

std::vector<std::string> commaSeparated(const std::string& text)
{
    std::vector<std::string> parts;
    std::istringstream in(text);
    for (std::string part; std::getline(in, part, ',');) parts.push_back(part);
    return parts;
}

} // namespace

BenchmarkOptions parseOptions(int argc, char** argv)
{
    BenchmarkOptions options;
    for (int i = 1; i < argc; ++i) {
        const std::string argument = argv[i];
        const std::size_t equals = argument.find('=');
        const std::string key = argument.substr(0, equals);
        const std::string value = equals == std::string::npos ? "" : argument.substr(equals + 1);
        if (argument == "--largest") {
            options.largest = true;
        } else if (argument == "--more") {
            options.more = true;
        } else if (key == "--json" && !value.empty()) {
            options.jsonFile = value;
        } else if (key == "--objects" && !value.empty()) {
            options.objects = commaSeparated(value);
        } else {
            throw std::invalid_argument("unknown argument '" + argument + "'");
        }
    }
    return options;
}

} // namespace spheretree_benchmark
