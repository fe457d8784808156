// SPDX-License-Identifier: Apache-2.0
#include "Messages.h"

namespace spheretree_test {

::testing::AssertionResult mentions(const std::string& text, const std::string& part)
{
    if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
    return ::testing::AssertionFailure() << "no \"" << part << "\" in \"" << text << "\"";
}

} // namespace spheretree_test
