// SPDX-License-Identifier: Apache-2.0
/// @file Expression.h
/// @brief `{...}` in values of options, which is vdb_tool's: reverse Polish notation, with `:` between
/// its words.
///
/// 1. A word is the name of a function (Functions.h), and takes its operands from the values before;
/// 2. or `$name`, a variable; or `@name`, which takes the last value and stores it;
/// 3. or `if(a?b)` and `switch(1:a?2:b)`, which take the last value and go on with one of their parts;
/// 4. or `quit`, which ends the expression;
/// 5. any other word is a value. An empty one is none.
///
/// What is left at the end, one value or none, stands in the place of the expression.

#pragma once

#include "Functions.h"

#include <string>

namespace command {

/// @return whether evaluate() would look at it.
bool hasExpression(const std::string& text);

/// @brief Put the values of all its expressions into a text.
/// @param stack  null before there is one
/// @throw CommandError (usage, or input of what is not on the stack) that names the expression;
///        NeedsStack if @a stack is null and that would be asked, or a variable is unknown
std::string evaluate(const std::string& text, Variables& variables, const StackFacts* stack);

/// @brief Have variables be unknown that the expressions of @a text store. If one has a name that cannot
/// be told, all variables are.
void setStoredUnknown(const std::string& text, Variables& variables);

} // namespace command
