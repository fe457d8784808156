// SPDX-License-Identifier: Apache-2.0
/// @file Functions.h
/// @brief The functions of expressions. Their names and results are vdb_tool's where it has them.

#pragma once

#include "Operands.h"
#include "Variables.h"

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace command {

/// What expressions may ask of the stack of grids, sphere-trees and meshes.
class StackFacts {
public:
    virtual ~StackFacts() = default;
    /// @param function  one of stackFunctions() with one operand
    /// @param age       of the grid, tree or mesh; 0 is the newest
    /// @throw CommandError (input) if there is none
    virtual std::string fact(const std::string& function, int64_t age) const = 0;
    /// Of the functions without an operand.
    virtual std::string count(const std::string& function) const = 0;
};

/// Thrown by what asks for the stack before there is one.
struct NeedsStack {};

/// What functions work on.
struct Evaluation {
    Operands operands = {};
    Variables& variables;
    const StackFacts* stack; ///< null before any work
};

struct Function {
    std::string name;
    std::size_t operands; ///< how many it takes
    std::string doc;      ///< an example with its result, and what it is where that is not plain
    std::function<void(Evaluation&)> run;
};

/// @name The functions by kind, in the order in which they are listed
/// @{
std::vector<Function> arithmeticFunctions();
std::vector<Function> logicFunctions();
std::vector<Function> operandFunctions();
std::vector<Function> textFunctions();
std::vector<Function> stackFunctions();
/// @}

/// @return all of them.
const std::vector<Function>& allFunctions();
/// @return that of the name, or null.
const Function* findFunction(const std::string& name);

} // namespace command
