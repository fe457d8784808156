// SPDX-License-Identifier: Apache-2.0
#include "InputStamp.h"

#include "base/Errors.h"

namespace command {

void InputStamp::requireUnchanged() const
{
    if (mStamp.isUnchanged()) return;
    throwInput(mStamp.path() + ": " + openvdb_spheretree::detail::kWasChanged);
}

} // namespace command
