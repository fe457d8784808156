// SPDX-License-Identifier: Apache-2.0
#include "support/VectorTarget.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "tests/support/VectorTarget.cc"
#include <hwy/foreach_target.h>

#include <hwy/highway.h>

HWY_BEFORE_NAMESPACE();
namespace spheretree_test {
namespace HWY_NAMESPACE {

/// A kernel that says what it was compiled for.
int64_t OwnTarget() { return HWY_TARGET; }

} // namespace HWY_NAMESPACE
} // namespace spheretree_test
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace spheretree_test {

HWY_EXPORT(OwnTarget);

std::string targetName(int64_t target) { return hwy::TargetName(target); }

std::string runningTarget() { return targetName(HWY_DYNAMIC_DISPATCH(OwnTarget)()); }

std::vector<int64_t> allTargets()
{
    std::vector<int64_t> targets;
    for (int64_t left = HWY_TARGETS; left != 0; left &= left - 1) {
        const int64_t target = left & -left;
        if ((hwy::SupportedTargets() & target) || target == HWY_STATIC_TARGET) {
            targets.push_back(target);
        }
    }
    return targets;
}

void forceTarget(int64_t target)
{
    hwy::SetSupportedTargetsForTest(target);
    hwy::GetChosenTarget().Update(hwy::SupportedTargets());
}

} // namespace spheretree_test
#endif
