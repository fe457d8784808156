// SPDX-License-Identifier: Apache-2.0
/// @file TemporaryFile.h
/// @brief The name of a file that nobody else uses, and that is gone when this is.

#pragma once

#include <filesystem>
#include <random>
#include <string>
#include <system_error>

namespace spheretree_benchmark {

class TemporaryFile {
public:
    explicit TemporaryFile(const std::string& extension)
        : mPath((std::filesystem::temp_directory_path()
            / ("spheretree-benchmark-" + std::to_string(std::random_device()()) + extension))
                    .string())
    {}
    ~TemporaryFile()
    {
        std::error_code ignored;
        std::filesystem::remove(mPath, ignored);
    }
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    const std::string& path() const { return mPath; }

private:
    std::string mPath;
};

} // namespace spheretree_benchmark
