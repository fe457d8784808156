// SPDX-License-Identifier: Apache-2.0
#include "FuzzTarget.h"

#include "inputs/InputReader.h"

#include <openvdb/openvdb.h>
#include <tbb/global_control.h>

#include <stdexcept>

// A leak of OpenVDB's (10.0.1), where a file ends between the sizes of attributes and their values.
extern "C" const char* __lsan_default_suppressions();
extern "C" const char* __lsan_default_suppressions()
{
    return "leak:compression::PagedInputStream::createHandle\n";
}

namespace spheretree_test {

int readAsFile(const char* extension, const uint8_t* data, std::size_t size, bool delayed)
{
    static const tbb::global_control oneThread(tbb::global_control::max_allowed_parallelism, 1);
    static const bool initialized = (openvdb::initialize(), true);
    static InputReader reader(extension);
    if (initialized) reader.read(textOf(data, size), delayed);
    return 0;
}

void require(bool holds, const char* what)
{
    if (!holds) throw std::logic_error(what);
}

} // namespace spheretree_test
