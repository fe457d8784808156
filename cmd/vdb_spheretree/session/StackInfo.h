// SPDX-License-Identifier: Apache-2.0
/// @file StackInfo.h
/// @brief What expressions such as `{0:voxelCount}` ask of the stack.

#pragma once

#include "expression/Functions.h"
#include "Stack.h"

namespace command {

class StackInfo : public StackFacts {
public:
    explicit StackInfo(const Stack& stack) : mStack(stack) {}
    std::string fact(const std::string& function, int64_t age) const override;
    std::string count(const std::string& function) const override;

private:
    const Stack& mStack;
};

} // namespace command
