// SPDX-License-Identifier: Apache-2.0
#include "DataFolder.h"

#include <zlib.h>

#include <stdexcept>

namespace spheretree_test {

std::string dataPath(const std::string& name)
{
    return std::string(SPHERETREE_TEST_DATA) + "/" + name;
}

std::string unpackedData(const std::string& name)
{
    const std::string path = dataPath(name + ".gz");
    const gzFile file = gzopen(path.c_str(), "rb");
    if (!file) throw std::runtime_error("no file " + path);
    std::string bytes;
    char part[4096];
    int size = 0;
    while ((size = gzread(file, part, sizeof(part))) > 0) bytes.append(part, std::size_t(size));
    gzclose(file);
    if (size < 0) throw std::runtime_error(path + " is damaged");
    return bytes;
}

} // namespace spheretree_test
