// SPDX-License-Identifier: Apache-2.0
#include "DataFolder.h"

namespace spheretree_test {

std::string dataPath(const std::string& name)
{
    return std::string(SPHERETREE_TEST_DATA) + "/" + name;
}

} // namespace spheretree_test
